/**
 * A headless browser for the tests of the editor and the dashboard, from the installed packages: nothing is downloaded
 * and no system package is needed on Linux x64 (the package carries Chromium and the libraries that it needs besides
 * the C library). Elsewhere an installed Chrome is used; `MELSEC_JW_BROWSER` names another executable.
 */
import { execFile } from 'node:child_process'
import { existsSync } from 'node:fs'
import { mkdir, mkdtemp, readFile, rename, rm, writeFile } from 'node:fs/promises'
import { join } from 'node:path'
import { promisify } from 'node:util'
import { type Browser, chromium, type LaunchOptions, type Page } from 'playwright-core'
import { root } from './root'

export interface OpenedPage {
  readonly page: Page
  /** What the page reported so far: uncaught errors, console errors, failed requests. A good page reports nothing. */
  readonly problems: readonly string[]
  close(): Promise<void>
}

export interface PageOptions {
  /** What the page's navigator tells; the editor picks its language by it. Default en-US. */
  readonly locale?: string
  /** Default 1280 x 800. */
  readonly viewport?: { readonly width: number; readonly height: number }
}

export interface HeadlessBrowser {
  /**
   * Opens a page in a context of its own and waits until it is loaded.
   * @example const { page } = await browser.openPage(red.url, { locale: 'ja' })
   */
  openPage(url: string, options?: PageOptions): Promise<OpenedPage>
  /** Opens the editor of a Node-RED and waits until its palette and flows are there (about five seconds). */
  openEditor(url: string, options?: PageOptions): Promise<OpenedPage>
  close(): Promise<void>
}

/** Starts the browser; about a second, and some three more the first time after an install. */
export async function launchBrowser(): Promise<HeadlessBrowser> {
  const browser = await chromium.launch(await launchOptions())
  return {
    openPage: (url, options = {}) => openPage(browser, url, options),
    openEditor: async (url, options = {}) => {
      const opened = await openPage(browser, url, options)
      await opened.page.waitForSelector('.red-ui-palette-node')
      await opened.page.waitForSelector('#red-ui-loading-progress', { state: 'hidden' })
      return opened
    },
    close: () => browser.close(),
  }
}

async function openPage(browser: Browser, url: string, options: PageOptions): Promise<OpenedPage> {
  const context = await browser.newContext({
    locale: options.locale ?? 'en-US',
    viewport: options.viewport ?? { width: 1280, height: 800 },
  })
  const page = await context.newPage()
  const problems: string[] = []
  page.on('pageerror', (error) => problems.push(`uncaught: ${error.stack ?? error.message}`))
  page.on('console', (message) => {
    if (message.type() === 'error') problems.push(`console: ${message.text()} (${message.location().url})`)
  })
  page.on('requestfailed', (request) => {
    problems.push(`request failed: ${request.url()} ${request.failure()?.errorText ?? ''}`)
  })
  await page.goto(url, { waitUntil: 'load' })
  return { page, problems, close: () => context.close() }
}

/** No sandbox: CI runs as root, where Chromium has none, and the pages are ours. The rest keeps it off the network. */
const ARGUMENTS = [
  '--no-sandbox',
  '--disable-gpu',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
]

async function launchOptions(): Promise<LaunchOptions> {
  const named = process.env.MELSEC_JW_BROWSER
  if (named) return { executablePath: named, args: ARGUMENTS }
  if (process.platform !== 'linux' || process.arch !== 'x64') return { channel: 'chrome', args: ARGUMENTS }
  const folder = await unpackedChromium()
  return {
    executablePath: join(folder, 'chromium'),
    args: ARGUMENTS,
    env: { ...process.env, LD_LIBRARY_PATH: join(folder, 'al2023', 'lib'), FONTCONFIG_PATH: join(folder, 'fonts') },
  }
}

/**
 * The package unpacks itself into the temporary folder, and takes a half unpacked file of another process for its own.
 * So a child of ours unpacks into a folder nobody else has, and renaming it makes it appear complete or not at all.
 */
async function unpackedChromium(): Promise<string> {
  const manifest = JSON.parse(await readFile(join(root, 'node_modules/@sparticuz/chromium/package.json'), 'utf8')) as {
    version: string
  }
  const cache = join(root, 'node_modules', '.cache')
  const folder = join(cache, `chromium-${manifest.version}`)
  if (existsSync(folder)) return folder
  await mkdir(cache, { recursive: true })
  const fresh = await mkdtemp(join(cache, 'unpack-'))
  try {
    await promisify(execFile)(
      process.execPath,
      ['--input-type=module', '-e', "await (await import('@sparticuz/chromium')).default.executablePath()"],
      // The second variable makes the package unpack the libraries it brings along, too.
      { cwd: root, env: { ...process.env, TMPDIR: fresh, AWS_LAMBDA_JS_RUNTIME: 'nodejs20.x' } },
    )
    await writeFile(join(fresh, 'fonts', 'fonts.conf'), fontsConf(folder))
    await rename(fresh, folder).catch((error: NodeJS.ErrnoException) => {
      // Another test worker was faster: its folder is as good as ours.
      if (error.code !== 'ENOTEMPTY' && error.code !== 'EEXIST') throw error
    })
  } finally {
    await rm(fresh, { recursive: true, force: true })
  }
  return folder
}

/** The package's own file names folders of the machine it was made for. The system's fonts add Japanese and Chinese. */
function fontsConf(folder: string): string {
  return `<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig>
  <dir>${folder}/fonts</dir>
  <dir>/usr/share/fonts</dir>
  <cachedir>${folder}/fonts-cache</cachedir>
</fontconfig>
`
}
