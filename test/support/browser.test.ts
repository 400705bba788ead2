import { createServer } from 'node:http'
import type { AddressInfo } from 'node:net'
import { afterAll, beforeAll, expect, test } from '@jest/globals'
import { type HeadlessBrowser, launchBrowser } from './browser'

const PAGE = `<!doctype html><title>Tank</title><button onclick="this.textContent = navigator.language">start</button>`
const BROKEN = `<!doctype html><title>Broken</title><script>undefinedFunction()</script>`

const server = createServer((request, response) => {
  response.setHeader('content-type', 'text/html')
  response.statusCode = request.url === '/favicon.ico' ? 204 : 200
  response.end(request.url === '/broken' ? BROKEN : PAGE)
})
let browser: HeadlessBrowser
let url: string

beforeAll(async () => {
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve))
  url = `http://127.0.0.1:${(server.address() as AddressInfo).port}/`
  browser = await launchBrowser()
}, 60_000)

afterAll(async () => {
  await browser.close()
  await new Promise((resolve) => server.close(resolve))
})

test('a page is opened, clicked and read, in the asked language', async () => {
  const { page, problems, close } = await browser.openPage(url, { locale: 'ja' })
  await page.getByRole('button').click()
  expect(await page.getByRole('button').textContent()).toBe('ja')
  expect(await page.title()).toBe('Tank')
  expect((await page.screenshot()).subarray(1, 4).toString()).toBe('PNG')
  expect(problems).toEqual([])
  await close()
})

test('what goes wrong in a page is reported', async () => {
  const { problems, close } = await browser.openPage(`${url}broken`)
  expect(problems).toEqual([expect.stringContaining('undefinedFunction')])
  await close()
})
