/** The programs of docs/jw-client.md run as they stand there, against a small PLC instead of the reader's. */
import { expect, test } from '@jest/globals'
import type { JwClientOptions } from '../../../src/client/jw/options'
import * as codec from '../../../src/entry/codec'
import * as library from '../../../src/index'
import { fencesOf } from '../../docs/markdown'
import { onSockets, SmallJw } from './small-jw'

const programs = fencesOf('docs/jw-client.md').filter(({ info }) => info.includes('js'))
const IMPORT = /^import (\{[^}]*\}) from '([^']+)'$/gm

test('there are programs', () => {
  expect(programs.length).toBeGreaterThanOrEqual(3)
})

test.each(programs.map(({ text, line }) => [line, text] as const))('the program in line %i', async (_line, text) => {
  const plc = new SmallJw()
  await onSockets('tcp', {}, plc, async (_client, port) => {
    const here = (options: JwClientOptions): JwClientOptions => ({ ...options, host: '127.0.0.1', port })
    const modules = {
      '@melsec-jw/plc': {
        ...library,
        createJwClient: (options: JwClientOptions) => library.createJwClient(here(options)),
        findJwHeader: (options: JwClientOptions) => library.findJwHeader(here(options)),
      },
      '@melsec-jw/plc/codec': codec,
    }
    const body = text.replace(
      IMPORT,
      (_, names: string, name: string) => `const ${names} = modules[${JSON.stringify(name)}]`,
    )
    const AsyncFunction = Object.getPrototypeOf(async () => {}).constructor as FunctionConstructor
    const printed: unknown[][] = []
    const print = (...values: unknown[]) => printed.push(values)
    await new AsyncFunction('modules', 'console', body)(modules, { log: print })
    expect(printed.length).toBeGreaterThan(0)
  })
})
