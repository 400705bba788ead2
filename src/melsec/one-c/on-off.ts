import type { ValueCodec } from '../../codec/codec'
import { RequestError } from '../../errors'

/** Set or reset of Test (BT), ON or OFF of the global signal (GW): one character. */
export const onOff: ValueCodec<boolean> = {
  name: 'ON/OFF',
  takes: 'true (ON) or false (OFF)',
  example: true,
  write(writer, value) {
    if (typeof value !== 'boolean') throw new RequestError('BAD_MESSAGE', `must be true or false, is ${String(value)}`)
    writer.bits([value])
  },
  read: (reader) => reader.bits(1)[0] === true,
  size: () => 1,
}
