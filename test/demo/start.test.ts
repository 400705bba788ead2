/** `npm start`: ports, addresses, and that nothing is left when it ends, however it ends. */
import { afterAll, beforeAll, describe, expect, jest, test } from '@jest/globals'
import { createJwClient, createMelsecClient } from '../../src/index'
import { childrenOf, eventually, isListening, isRunning, type RunningDemo, startDemo } from './running'

jest.setTimeout(150_000)

const portOf = (url: string): number => Number(new URL(url).port)
const portsOf = (demo: RunningDemo): number[] => [portOf(demo.editor), demo.iqr, demo.fx5, demo.jw]
const listening = (ports: readonly number[]): Promise<boolean[]> => Promise.all(ports.map(isListening))

describe('two demos started at the same time', () => {
  let demos: RunningDemo[] = []
  let children: number[] = []

  beforeAll(async () => {
    // All settled first: one that fails must not leave the other running.
    const started = await Promise.allSettled([startDemo(), startDemo()])
    demos = started.flatMap((result) => (result.status === 'fulfilled' ? [result.value] : []))
    const failed = started.find((result) => result.status === 'rejected')
    if (failed) throw failed.reason
    children = (await Promise.all(demos.map(({ pid }) => childrenOf(pid)))).flat().map(({ pid }) => pid)
  })

  afterAll(async () => {
    await Promise.all(demos.map((demo) => demo.cleanUp()))
  })

  const [first, second] = [() => at(0), () => at(1)]
  function at(index: number): RunningDemo {
    const demo = demos[index]
    if (demo === undefined) throw new Error(`demo ${index} is not there`)
    return demo
  }

  test('each has ports of its own, and one says which of the usual ones were taken', () => {
    expect(new Set(demos.flatMap(portsOf)).size).toBe(8)
    const printed = demos.map((demo) => demo.output()).join('\n')
    expect(printed).toMatch(/Port 1880 is taken: Node-RED has \d+ instead\./)
    expect(printed).toMatch(/Port 5007 is taken: the simulated MELSEC iQ-R has \d+ instead\./)
    expect(printed).toMatch(/Port 5008 is taken: the simulated MELSEC iQ-F FX5U has \d+ instead\./)
    expect(printed).toMatch(/Port 5009 is taken: the simulated Sharp JW300 has \d+ instead\./)
  })

  test('nothing but the addresses is printed when all is well', () => {
    for (const demo of demos) expect(demo.output()).not.toMatch(/warn|error|deprecat/i)
  })

  test('editor and dashboard answer at the printed addresses, which are on 127.0.0.1', async () => {
    for (const { editor, dashboard } of demos) {
      expect([editor, dashboard].map((url) => new URL(url).hostname)).toEqual(['127.0.0.1', '127.0.0.1'])
      expect((await fetch(editor)).status).toBe(200)
      expect((await fetch(dashboard)).status).toBe(200)
    }
  })

  test('a page from elsewhere, open in the same browser, may not deploy flows', async () => {
    const flows = (origin: string, method: string) =>
      fetch(`${first().editor}flows`, { method, headers: { origin, 'access-control-request-method': 'POST' } })
    const asked = await flows('http://elsewhere.example', 'OPTIONS')
    expect([asked.status, asked.headers.get('access-control-allow-origin')]).toEqual([403, null])
    expect((await flows('http://elsewhere.example', 'POST')).status).toBe(403)
    expect((await flows(new URL(first().editor).origin, 'GET')).status).toBe(200)
  })

  test.each([
    ['the iQ-R', '4E', 'tcp', 'iq-r'],
    ['the iQ-R', '3E', 'udp', 'iq-r'],
    ['the FX5U', '3E', 'tcp', 'iq-f'],
  ] as const)('%s answers %s over %s at the printed port', async (_name, frame, transport, profile) => {
    const port = profile === 'iq-r' ? first().iqr : first().fx5
    const client = createMelsecClient({ host: '127.0.0.1', port, profile, frame, transport })
    try {
      expect((await client.identify()).model).toMatch(profile === 'iq-r' ? /^R\d+/ : /^FX5U/)
    } finally {
      await client.close()
    }
  })

  test.each(['tcp', 'udp'] as const)('the Sharp JW answers over %s at the printed port', async (transport) => {
    const client = createJwClient({ host: '127.0.0.1', port: first().jw, transport })
    try {
      expect(await client.info()).toMatchObject({ runState: 'running', writeMode: 'data' })
    } finally {
      await client.close()
    }
  })

  test('the nodes of each demo have reached their own PLCs', async () => {
    for (const { iqr, fx5 } of demos) {
      for (const [port, profile] of [
        [iqr, 'iq-r'],
        [fx5, 'iq-f'],
      ] as const) {
        const client = createMelsecClient({ host: '127.0.0.1', port, profile })
        try {
          expect(await client.read('SM400')).toBe(true)
        } finally {
          await client.close()
        }
      }
    }
  })

  test('SIGINT, which Ctrl-C sends, ends all of one demo with exit code 0 and leaves the other alone', async () => {
    expect(await first().end('SIGINT')).toBe(0)
    expect(first().output()).toContain('The demo has ended.')
    expect(await listening(portsOf(first()))).toEqual([false, false, false, false])
    expect((await childrenOf(first().pid)).length).toBe(0)
    expect(await listening(portsOf(second()))).toEqual([true, true, true, true])
  })

  test('when the simulated plant dies, Node-RED is ended too: the reason and exit code 1', async () => {
    const plant = (await childrenOf(second().pid)).find(({ command }) => command.includes('plant.mjs'))
    if (plant === undefined) throw new Error('the simulated plant is not there')
    process.kill(plant.pid, 'SIGKILL')
    expect(await second().ended()).toBe(1)
    expect(second().output()).toContain('The simulated plant has ended by itself (SIGKILL)')
    expect(await listening(portsOf(second()))).toEqual([false, false, false, false])
  })

  test('no process of either is left', async () => {
    expect(children.length).toBe(4)
    await eventually(
      'the processes to be gone',
      () => children.filter(isRunning),
      (left) => left.length === 0,
    )
  })
})

describe('a demo', () => {
  test('that is killed takes its processes with it', async () => {
    const demo = await startDemo()
    try {
      const children = (await childrenOf(demo.pid)).map(({ pid }) => pid)
      expect(children.length).toBe(2)
      await demo.end('SIGKILL')
      await eventually(
        'the processes to be gone',
        () => children.filter(isRunning),
        (left) => left.length === 0,
      )
      expect(await listening(portsOf(demo))).toEqual([false, false, false, false])
    } finally {
      await demo.cleanUp()
    }
  })

  test('ends with exit code 0 on SIGTERM', async () => {
    const demo = await startDemo()
    try {
      expect(await demo.end('SIGTERM')).toBe(0)
      expect(await listening(portsOf(demo))).toEqual([false, false, false, false])
    } finally {
      await demo.cleanUp()
    }
  })
})
