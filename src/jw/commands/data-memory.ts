// Relays, registers, timers and counters. DATA of a relay is 00H (off, reset) or 01H (on, set).
import { field } from '../../codec/codec'
import { jwAddress, jwExtendedAddress } from '../address-codec'
import { type JwDeclaration, section } from './command'

const { bytes, countOf, each, echo, fixedInForm, list, repeat, u16, u8, value, words } = field

/** Where the marker of extended addresses stands in the lists of 21, 27, 31 and 37: the form of these messages. */
export const markerForms = { once: 0, each: 1 } as const

const MARKER = 0xff
/** Once, before the first element: so the manual draws all eight tables. */
const once = fixedInForm(MARKER, 1, markerForms.once, 'marker of the extended form, before the first address')
/** Before each element: an extended address is six bytes everywhere else. */
const inEach = fixedInForm(MARKER, 1, markerForms.each, 'marker of the extended form, before each address')
const MARKER_OPEN = 'Whether FFH stands once or before each address; with one address both are the same bytes.'

const bit = u8({ max: 7, doc: 'bit of the byte' })
const onOff = u8({ max: 1, doc: '0 off, 1 on' })
const setReset = u8({ max: 1, doc: '0 reset, 1 set' })
const byte = u8({ doc: 'a byte' })
const address = value(jwExtendedAddress, 'byte')
const length = u16({ min: 1, max: 1024, doc: 'bytes' })
const elements = countOf('items', 1, { min: 1, max: 128 })
/** What an answer repeats of each relay or register. */
const relayAgain = { marker: inEach, address: echo('address'), bit: echo('bit') }
const registerAgain = { marker: inEach, address: echo('address') }

export const dataMemoryCommands = {
  /** Monitors one relay. 47 00 20 | 00 03 01 03 -> 45 00 20 00 | 00 03 01 03 01: relay 04033 is on. */
  monitorRelay: {
    title: 'Monitor relay',
    code: 0x20,
    effect: 'read',
    manual: section('20'),
    confidence: 'printed',
    request: { address: value(jwAddress, 'byte of the relay'), bit },
    response: { address: echo('address'), bit: echo('bit'), value: onOff },
  },

  /** Monitors up to 128 relays anywhere. 47 00 21 | 02 FF 00 03 01 00 00 03 00 00 00 00 00 00: relays 04033 and 00000. */
  monitorRelays: {
    title: 'Monitor relays',
    code: 0x21,
    effect: 'read',
    manual: section('21'),
    confidence: 'assumed',
    open: MARKER_OPEN,
    models: ['jw300'],
    request: { count: elements, marker: once, items: list('count', { marker: inEach, address, bit }) },
    response: { count: echo('count'), marker: once, values: each('items', onOff, relayAgain) },
  },

  /** Values and attributes of up to 256 timers, counters and MD. 47 00 23 | 00 00 02 00: numbers 0 and 1. */
  monitorTimersCounters: {
    title: 'Monitor timers, counters and MD',
    code: 0x23,
    effect: 'read',
    manual: section('23'),
    confidence: 'printed',
    open: 'What bit 15 of a value says: a printed example has it set and does not count it.',
    request: { number: u16({ doc: 'first number' }), points: u16({ min: 1, max: 256 }) },
    response: {
      number: echo('number'),
      points: echo('points'),
      words: words('points', 'present values'),
      attributes: bytes('points', '0000JXYZ; J 1: X counter, Y up, Z binary; J 0: 4 ZW timer, 2 ZW counter, 1 MD'),
    },
  },

  /** 1 to 1024 bytes in a row. 47 00 24 | 00 00 08 04 00: registers 09000 to 09003. */
  readDataMemory: {
    title: 'Read data memory',
    code: 0x24,
    effect: 'read',
    manual: section('24'),
    confidence: 'printed',
    extent: { first: 'head', size: 'length' },
    request: { head: value(jwAddress, 'first byte'), length },
    response: { head: echo('head'), length: echo('length'), data: bytes('length') },
  },

  /** Monitors up to 128 bytes anywhere. 47 00 27 | 01 FF 00 00 08 00 00: register 09000. */
  monitorRegisters: {
    title: 'Monitor registers',
    code: 0x27,
    effect: 'read',
    manual: section('27'),
    confidence: 'assumed',
    open: MARKER_OPEN,
    models: ['jw300'],
    request: { count: elements, marker: once, items: list('count', { marker: inEach, address }) },
    response: { count: echo('count'), marker: once, values: each('items', byte, registerAgain) },
  },

  /** Sets or resets one relay. 47 00 30 | 00 03 01 03 01: sets relay 04033. */
  setRelay: {
    title: 'Set/reset relay',
    code: 0x30,
    effect: 'write',
    manual: section('30'),
    confidence: 'derived',
    request: { address: value(jwAddress, 'byte of the relay'), bit, value: setReset },
    response: { address: echo('address'), bit: echo('bit') },
  },

  /** Sets and resets up to 128 relays anywhere. 47 00 31 | 01 FF 00 03 01 00 00 03 01: sets relay 04033. */
  setRelays: {
    title: 'Set/reset relays',
    code: 0x31,
    effect: 'write',
    manual: section('31'),
    confidence: 'assumed',
    open: MARKER_OPEN,
    models: ['jw300'],
    request: { count: elements, marker: once, items: list('count', { marker: inEach, address, bit, value: setReset }) },
    response: { count: echo('count'), marker: once, items: repeat('items', relayAgain) },
  },

  /** Sets or resets a timer or counter, while the PLC runs. 47 00 32 | FF 01 01: sets number 777 octal. */
  setTimerCounter: {
    title: 'Set/reset timer or counter',
    code: 0x32,
    effect: 'write',
    manual: section('32'),
    confidence: 'derived',
    request: { number: u16(), value: setReset },
    response: { number: echo('number') },
  },

  /** Writes 1 to 1024 bytes in a row. 47 00 34 | 00 00 08 02 00 34 12: 1234H to 09000 and 09001. */
  writeDataMemory: {
    title: 'Write data memory',
    code: 0x34,
    effect: 'write',
    manual: section('34'),
    confidence: 'derived',
    extent: { first: 'head', size: 'data' },
    request: {
      head: value(jwAddress, 'first byte'),
      length: countOf('data', 2, { min: 1, max: 1024 }),
      data: bytes('length'),
    },
    response: { head: echo('head'), length: echo('length') },
  },

  /** Writes the same byte 1 to 1024 times. 47 00 35 | 00 00 08 00 02 00: clears 09000 to 09777. */
  fillDataMemory: {
    title: 'Fill data memory',
    code: 0x35,
    effect: 'write',
    manual: section('35'),
    confidence: 'derived',
    extent: { first: 'head', size: 'length' },
    request: { head: value(jwAddress, 'first byte'), length, value: byte },
    response: { head: echo('head'), length: echo('length') },
  },

  /** Writes up to 128 bytes anywhere. 47 00 37 | 01 FF 00 00 08 00 00 5A: 5AH to 09000. */
  writeRegisters: {
    title: 'Write registers',
    code: 0x37,
    effect: 'write',
    manual: section('37'),
    confidence: 'assumed',
    open: MARKER_OPEN,
    models: ['jw300'],
    request: { count: elements, marker: once, items: list('count', { marker: inEach, address, value: byte }) },
    response: { count: echo('count'), marker: once, items: repeat('items', registerAgain) },
  },
} as const satisfies Readonly<Record<string, JwDeclaration>>
