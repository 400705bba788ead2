// A port that is given up while the system opens it, which takes an adapter a moment.
import { expect, jest, test } from '@jest/globals'
import { serialTransport } from '../../src/transport/serial'

const done: string[] = []
let isAbsent = false

class SlowPort {
  isOpen = false
  readonly path: string

  constructor({ path }: { readonly path: string }) {
    this.path = path
  }

  on() {}

  open(then: (error: Error | null) => void) {
    done.push('open')
    setTimeout(() => {
      this.isOpen = !isAbsent
      then(isAbsent ? new Error('No such file or directory') : null)
    }, 10)
  }

  close(then: () => void) {
    this.isOpen = false
    setTimeout(() => {
      done.push('closed')
      then()
    }, 10)
  }
}

jest.mock('serialport', () => ({ SerialPort: SlowPort }))

const opening = () => new Promise<void>((resolve) => setImmediate(resolve))

test('is closed before the next one opens it: nobody is told that another program has it', async () => {
  const make = serialTransport({ path: 'COM3' })
  const first = make()
  first.open({ opened: () => done.push('opened too late'), received() {}, closed() {} })
  await opening()
  first.close()
  const second = make()
  await new Promise<void>((opened) => second.open({ opened, received() {}, closed() {} }))
  expect(done).toEqual(['open', 'closed', 'open'])
  second.close()
})

test('that cannot be opened is tried again at once', async () => {
  const make = serialTransport({ path: 'COM4' })
  isAbsent = true
  await new Promise<void>((closed) => make().open({ opened() {}, received() {}, closed: () => closed() }))
  isAbsent = false
  const second = make()
  await new Promise<void>((opened) => second.open({ opened, received() {}, closed() {} }))
  second.close()
})
