/** The programs marked `runnable` in the documentation run, and print what the documentation says they print. */
import { afterEach, beforeEach, describe, expect, test } from '@jest/globals'
import { type Fence, fencesOf, pages } from './markdown'
import { Bench } from './programs'

/** Programs and, behind them, what they print, where the documentation shows it. */
const programs = pages.flatMap((page) => {
  const fences = fencesOf(page)
  return fences.flatMap((fence, index): { name: string; program: Fence; output: string | undefined }[] => {
    if (!fence.info.includes('runnable')) return []
    const next = fences[index + 1]
    const output = next?.info.includes('output') ? next.text.trimEnd() : undefined
    return [{ name: `${page}:${fence.line}`, program: fence, output }]
  })
})

describe('the program in', () => {
  let bench: Bench

  beforeEach(async () => {
    bench = new Bench()
    await bench.open()
  })

  afterEach(() => bench.close())

  test.each(programs)('$name runs', async ({ program, output }) => {
    const printed = await bench.run(program)
    if (output !== undefined) expect(printed).toBe(output)
  })
})

test('README and docs/client.md have programs to run', () => {
  expect(programs.map(({ program }) => program.page)).toEqual(expect.arrayContaining(['README.md', 'docs/client.md']))
})
