/** The benchmarks measure nothing here; they must only run, which nobody would notice otherwise. */
import { execFile } from 'node:child_process'
import { resolve } from 'node:path'
import { promisify } from 'node:util'
import { expect, test } from '@jest/globals'

const run = promisify(execFile)

test('every benchmark runs to its end', async () => {
  const { stdout } = await run(process.execPath, [resolve(__dirname, '../bench/main.mjs'), '--quick'])
  const rows = stdout.split('\n').filter((line) => /\s\d+(\.\d+)?$/.test(line))
  for (const [row, times] of [
    ['one word: client', 2],
    ['960 words: client', 2],
    ['one word: 3E, ports of its own', 2],
    ['scattered words', 1],
    ['mixed items', 1],
    ['words x 960', 2],
    ['Read (word units), 960 point(s)', 2],
    ['960 words, 4C format 5', 1],
    ['far apart, 1C format 1', 1],
  ] as const) {
    expect(rows.filter((line) => line.startsWith(row))).toHaveLength(times)
  }
}, 60_000)
