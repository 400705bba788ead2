// The A-compatible set: commands of the 1E frame (FX5 communication manual 39). Another set of declarations with its
// own codes, order and device codes, not options on the SLMP set.
import { declare, field } from '../codec/codec'
import { aCompatibleDevice } from './a-compatible-device'

const { fixed, u8, value, words } = field

/** Commands of the 1E frame. The code is the frame's subheader. */
export const aCompatibleCommands = declare({
  readWords: {
    title: 'Batch read (word units)',
    code: 0x01,
    effect: 'read',
    manual: 'FX5 communication manual 39.2',
    request: {
      head: value(aCompatibleDevice, 'first device'),
      points: u8({ min: 1, max: 256, zeroMeans: 256, doc: 'words: 1 to 64, of bit devices 1 to 32' }),
      reserved: fixed(0, 1),
    },
    response: { values: words('points') },
  },
})

export type ACompatibleCommands = typeof aCompatibleCommands
