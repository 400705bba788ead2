/** The dialogs of the nodes in the real editor, as the tests of the editor open and close them. */
import { mkdir } from 'node:fs/promises'
import { join } from 'node:path'
import type { Page } from 'playwright-core'

/** What the editor's own code offers to its page. */
export interface Editor {
  readonly RED: {
    readonly editor: { edit(node: unknown): void; editConfig(name: string, type: string, id: string): void }
    readonly workspaces: { show(id: string): void }
    readonly nodes: {
      node(id: string): Record<string, unknown>
      eachNode(look: (node: { id: string; valid?: boolean }) => void): void
      eachConfig(look: (node: { id: string; valid?: boolean }) => void): void
    }
  }
}

export async function edit(page: Page, id: string): Promise<void> {
  const trays = await page.locator('.red-ui-tray').count()
  const form = page.locator('.red-ui-tray-body .melsec-jw-form').last()
  // The editor ignores the wish while it is still closing the dialog before, so it is repeated as long as none opens.
  for (let tries = 1; ; tries += 1) {
    await open(page, id, trays)
    try {
      await form.waitFor({ timeout: 3000 })
      break
    } catch (error) {
      if (tries === 5) throw error
    }
  }
  // The tray slides in.
  await page.waitForFunction(() => {
    const tray = [...document.querySelectorAll('.red-ui-tray')].at(-1)
    return tray !== undefined && tray.getBoundingClientRect().right <= window.innerWidth + 1
  })
}

/** Asks for the dialog, unless one more than before is opening already. */
function open(page: Page, id: string, before: number): Promise<void> {
  return page.evaluate(
    ([node, trays]) => {
      const { RED } = globalThis as unknown as Editor
      if (document.querySelectorAll('.red-ui-tray').length > trays) return
      if (node === 'line') RED.editor.editConfig('', 'melsec-jw-line', node)
      else if (/^plc\d?$/.test(node)) RED.editor.editConfig('', 'melsec-jw-connection', node)
      else RED.editor.edit(RED.nodes.node(node))
    },
    [id, before] as const,
  )
}

export async function close(page: Page, button: 'ok' | 'cancel'): Promise<void> {
  await page.locator(`#node-dialog-${button}:visible, #node-config-dialog-${button}:visible`).last().click()
  await page.locator('.red-ui-tray').waitFor({ state: 'detached' })
}

/** Turns to a page of the dialog. The editor takes two clicks in quick succession for one, so it is clicked until it is there. */
export async function turnTo(page: Page, tabs: string, number: number): Promise<void> {
  const tab = page.locator(`#${tabs} > li`).nth(number)
  for (let tries = 1; !(await tab.getAttribute('class'))?.split(' ').includes('active'); tries += 1) {
    if (tries > 20) throw new Error(`page ${number} of the dialog does not open`)
    await tab.locator('a').first().click()
    await page.waitForTimeout(100)
  }
}

export function property(page: Page, id: string, name: string): Promise<unknown> {
  return page.evaluate(
    ([node, field]) => (globalThis as unknown as Editor).RED.nodes.node(node ?? '')[field ?? ''],
    [id, name],
  )
}

export async function picture(page: Page, name: string): Promise<void> {
  const folder = process.env.MELSEC_JW_SCREENSHOTS
  if (folder === undefined) return
  await mkdir(folder, { recursive: true })
  await page.screenshot({ path: join(folder, `${name}.png`) })
}
