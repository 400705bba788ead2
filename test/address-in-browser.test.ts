// `@melsec-jw/plc/address` as an editor in a browser has it: bundled without anything of Node.js, and run in one.
import { createServer } from 'node:http'
import type { AddressInfo } from 'node:net'
import { join } from 'node:path'
import { afterAll, beforeAll, expect, test } from '@jest/globals'
import { build as bundle } from 'esbuild'
import { build } from './cli/cli'
import { type HeadlessBrowser, launchBrowser } from './support/browser'
import { root } from './support/root'

const program = `import { formatItem, formatJwItem, formatJwOperand, parseItem, parseJwOperand, placeOfJw, RequestError, tryParseItem, tryParseJwItem } from '@melsec-jw/plc/address'
const shown = (text, xyRadix = 16) => {
  const item = tryParseItem(text, { xyRadix })
  return 'error' in item ? item.error.code + ': ' + item.error.message : formatItem(item, { xyRadix }) + ' ' + item.type.name
}
const jw = (text) => {
  const item = tryParseJwItem(text)
  return 'error' in item ? item.error.code + ': ' + item.error.message : formatJwItem(item) + ' ' + item.type.name
}
const thrown = () => { try { parseItem('Q1', { xyRadix: 16 }) } catch (error) { return error instanceof RequestError } }
document.body.textContent = JSON.stringify({
  here: [typeof globalThis.Buffer, typeof globalThis.process, typeof globalThis.require],
  shown: [shown('d0100:real[2]'), shown('X10..X17', 8), shown('K4M0'), shown('U3\\\\G100.F'), shown('X18', 8), shown('D100:STR,10')],
  jw: [jw('004033'), jw('09000..09017:int'), jw('f1:1234:real[2]'), jw('コ0403'), jw('TMR012'), jw('09018'), jw('D100')],
  operand: [formatJwOperand(parseJwOperand('9012'.padStart(5, '0'))), placeOfJw(parseJwOperand('09012.3'))],
  thrown: thrown(),
  plain: new RequestError('BAD_VALUE', 'm').toJSON(),
})`

let browser: HeadlessBrowser
let text: string
const server = createServer((request, response) => {
  const isScript = request.url === '/program.js'
  response.setHeader('content-type', isScript ? 'text/javascript; charset=utf-8' : 'text/html; charset=utf-8')
  response.statusCode = request.url === '/favicon.ico' ? 204 : 200
  response.end(isScript ? text : '<!doctype html><body><script src="program.js"></script></body>')
})

beforeAll(async () => {
  build()
  const { outputFiles } = await bundle({
    // The package finds itself by its name and exports.
    stdin: { contents: program, resolveDir: join(root, 'test') },
    bundle: true,
    platform: 'browser',
    format: 'iife',
    write: false,
    logLevel: 'error',
  })
  text = outputFiles[0]?.text ?? ''
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve))
  browser = await launchBrowser()
}, 60_000)

afterAll(async () => {
  await browser?.close()
  await new Promise((resolve) => server.close(resolve))
})

test('addresses are checked in a browser, without anything of Node.js', async () => {
  const { page, problems, close } = await browser.openPage(
    `http://127.0.0.1:${(server.address() as AddressInfo).port}/`,
  )
  const told = JSON.parse((await page.textContent('body')) ?? '') as unknown
  expect(told).toEqual({
    here: ['undefined', 'undefined', 'undefined'],
    shown: [
      'D100:REAL[2] REAL',
      'X10[8] BOOL',
      'K4M0 INT',
      'U3\\G100.F BOOL',
      expect.stringMatching(/^BAD_ADDRESS: /),
      expect.stringMatching(/^BAD_\w+: .*STRING\(10\)/),
    ],
    jw: [
      '004033 BOOL',
      '09000:INT[8] INT',
      'F1:00001234:REAL[2] REAL',
      'KO0403 BYTE',
      'TMR0012 UINT',
      expect.stringMatching(/^BAD_ADDRESS: .*octal/),
      expect.stringMatching(/^BAD_ADDRESS: .*MELSEC/),
    ],
    operand: ['09012', { in: 'file', file: 0, address: 0o4012, bit: 3 }],
    thrown: true,
    plain: { name: 'RequestError', code: 'BAD_VALUE', message: 'm', outcome: 'notSent' },
  })
  expect(problems).toEqual([])
  await close()
})
