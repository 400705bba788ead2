// What the end codes of answers are about, and with which of them a write may have been carried out all the same: what
// programs decide by. Apart from the texts, which are large and loaded when somebody wants to read them.
//
// No manual says that a request refused because of a device, its size or a state was carried out in part: the PLC checks
// it before it begins. It is different where a module or another station is asked on the way, and where memory is written.
import { type EndCodeFacts, type EndCodeTable, endCodeFacts } from '../../link/link'
import type { MelsecEndCodeFamily } from './family'

const slmp: EndCodeTable = {
  about: {
    item: [
      [0x4030, 0x4034],
      [0x4040, 0x4044],
      0x40c0,
      0x7143,
      0x7164,
      0x7e43,
      0x7f22,
      0xc056,
      [0xc05a, 0xc05c],
      0xc060,
      0xc070,
      0xc072,
      0xc1a9,
      0xc1aa,
    ],
    size: [0x4005, 0x4080, 0x7e41, 0x7e42, [0xc051, 0xc055], 0xc071, 0xc075, 0xc0d8],
    command: [0x4001, 0x4002, 0x7e40, 0xc059, 0xc073, 0xc0d9, 0xc1a4],
    request: [0x4027, 0x7f21, 0x7f23, 0xc050, 0xc057, 0xc058, 0xc061, 0xc0b5, 0xc208],
    file: [
      [0x4021, 0x4026],
      [0x4028, 0x402c],
      0x41c5,
      0x41c7,
      [0x41cc, 0x41cf],
      0x41d8,
      0x41df,
      0x41e4,
      0x41eb,
      0x41fe,
      0x4c40,
      0x4c43,
      0xc207,
    ],
    state: [
      0x0055,
      0x4004,
      0x4006,
      0x4008,
      0x4010,
      0x4013,
      [0x4050, 0x4054],
      0x4060,
      0x4068,
      0x4082,
      0x408b,
      0x4100,
      [0x480c, 0x480e],
      0x4c44,
      0x7155,
      0x7167,
      0x7168,
      0x7e47,
      0x7f26,
      0x7fe6,
      0xc05d,
      [0xc200, 0xc205],
      0xc810,
      0xc815,
      0xc816,
    ],
    route: [
      0x4003,
      [0x4a00, 0x4a02],
      0x4b00,
      0x4b02,
      0x4b03,
      0x4c00,
      0x7157,
      0xc035,
      0xc05e,
      0xc05f,
      0xc0b2,
      0xc0d3,
      0xc0d4,
      0xc1a2,
      0xc1a5,
      0xc1a7,
      0xc1a8,
    ],
    transmission: [0x4000, 0x7f24, 0x7f40, [0x7f67, 0x7f69], 0xc040],
  },
  perhapsCarriedOut: [
    0x4040, // the module behind U\G is asked in the middle of the request
    0x4042,
    0x4044,
    0x4053, // writing to the memory failed
    0x4054,
    0x4100, // hardware
    0x41cf, // the drive is full
    0x41e4,
    0x4c43,
    0x4b00, // an error at the target or on the way, without which one
    0xc05e, // no answer within the monitoring timer
    0xc0b2, // no free buffer: on the way there or back
    0xc1a2, // no answer of the target
  ],
}

/** End codes of the 1E frame, and the abnormal codes behind end code 5BH: their numbers do not meet. */
const of1e: EndCodeTable = {
  about: {
    item: [0x12, [0x56, 0x58]],
    command: [0x50],
    request: [0x54],
    state: [0x11, 0x18, 0x55, 0x60],
    route: [0x10],
  },
  perhapsCarriedOut: [0x60], // the CPU did not answer the module within the monitoring timer
}

const of1c: EndCodeTable = {
  about: { item: [0x06], request: [0x03, 0x07], state: [0x18], route: [0x10], transmission: [0x02] },
  perhapsCarriedOut: [],
}

export const endCodeTables: Readonly<Record<MelsecEndCodeFamily, EndCodeTable>> = { slmp, '1E': of1e, '1C': of1c }

export const factsOf: Readonly<Record<MelsecEndCodeFamily, EndCodeFacts>> = {
  slmp: endCodeFacts(slmp),
  '1E': endCodeFacts(of1e),
  '1C': endCodeFacts(of1c),
}
