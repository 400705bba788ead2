// What the result codes of a JW are about (JW300 manual, result codes). MELSEC uses most of these numbers for something else.
import { type EndCodeTable, endCodeFacts } from '../../link/link'

export const resultCodes: EndCodeTable = {
  about: {
    item: [
      0x02, // no preset of a timer, counter or MD
      0x04, // set or reset of an MD
      0x08, // behind the end of the memory or file
      0x11, // not in the program area
      0x21, // an operand word
    ],
    size: [0x4c], // behind the end of the specified buffer
    command: [0x34, 0x39], // the model has no clock; I/O command on a ZW
    request: [0x01, [0x22, 0x26], 0x32, 0x38, 0x52],
    state: [
      0x06, // the PLC is not stopped
      0x07, // the write was not done correctly
      0x0e, // the program memory is protected
      0x0f, // the memory did not answer in time
      0x10, // the write mode does not allow it
      0x12, // the memory is a ROM
      0x13, // the PLC is stopped
      0x1b, // system memory abnormal
      [0x30, 0x31], // password
      0x33,
      [0x40, 0x44], // ring buffer
      [0x48, 0x49], // specified buffer
      0x4b,
      0x53, // system memory not correct
    ],
  },
  // The manual does not say whether what stands before a refused address was written, nor how far it came with the others.
  perhapsCarriedOut: [0x02, 0x04, 0x07, 0x08, 0x0f, 0x11, 0x1b, 0x21, 0x44, 0x4c, 0x53],
}

export const resultFacts = endCodeFacts(resultCodes)
