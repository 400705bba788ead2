// Request to send, which a pair of ttys does not have: what the port is told, in its order.
import { beforeEach, expect, jest, test } from '@jest/globals'
import { serialTransport } from '../../src/transport/serial'

const done: unknown[] = []
/** Setting takes the adapter a moment. */
let isSlow = false

class FakePort {
  isOpen = false

  on() {}

  open(then: (error: null) => void) {
    this.isOpen = true
    then(null)
  }

  set(options: object, then?: (error: null) => void) {
    if (!isSlow) {
      done.push(options)
      then?.(null)
      return
    }
    setImmediate(() => {
      done.push(options)
      then?.(null)
    })
  }

  write() {
    done.push('write')
  }

  drain(then: () => void) {
    done.push('drain')
    then()
  }

  close(then: () => void) {
    done.push('close')
    then()
  }
}

jest.mock('serialport', () => ({ SerialPort: FakePort }))

beforeEach(() => {
  done.length = 0
  isSlow = false
})

test.each([
  ['on', ['write', 'close']],
  ['off', [{ rts: false }, 'write', 'close']],
  ['sending', [{ rts: false }, { rts: true }, 'write', 'drain', { rts: false }, 'close']],
] as const)('%s', async (rts, expected) => {
  const transport = serialTransport({ path: 'COM3', rts })()
  await new Promise<void>((opened) => transport.open({ opened, received() {}, closed() {} }))
  transport.send(Buffer.of(1))
  transport.close()
  expect(done).toEqual(expected)
})

test('sending: nothing goes out before the converter drives the line, and it does until all of it is out', async () => {
  const transport = serialTransport({ path: 'COM3', rts: 'sending' })()
  await new Promise<void>((opened) => transport.open({ opened, received() {}, closed() {} }))
  done.length = 0
  isSlow = true
  transport.send(Buffer.of(4))
  transport.send(Buffer.of(5))
  while (done.length < 8) await new Promise((resolve) => setImmediate(resolve))
  const once = [{ rts: true }, 'write', 'drain', { rts: false }]
  expect(done).toEqual([...once, ...once])
  transport.close()
})
