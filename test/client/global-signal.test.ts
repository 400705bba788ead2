/** The global signal of a serial line: of one station, and of all, which nobody answers unless the option says so. */
import { afterEach, expect, test } from '@jest/globals'
import { createMelsecClient, type SerialFrameDetails } from '../../src/index'
import { listenMemory } from '../../src/transport/memory'

const ends: (() => unknown)[] = []
afterEach(async () => {
  for (const end of ends.splice(0)) await end()
})

/** Format 1 without sum: what is asked, as text with its control codes in words, and what is answered. */
function clientOf(answers: Readonly<Record<string, string>>, serialFrame: SerialFrameDetails = {}) {
  const asked: string[] = []
  const memory = listenMemory({}, (peer) => {
    peer.onReceived = (chunk) => {
      const text = chunk.toString('latin1')
      if (text === '\x04') return
      asked.push(text.replace('\x05', '<ENQ>'))
      const answer = answers[text.slice(1)]
      if (answer !== undefined) peer.send(Buffer.from(answer, 'latin1'))
    }
  })
  const client = createMelsecClient({
    host: 'in memory',
    port: 1,
    profile: 'fx3-serial',
    sumCheck: false,
    serialFrame,
    probe: 'none',
    allowControl: true,
    route: { station: 5 },
    serial: { answerTime: 60, quiet: 5, betweenBytes: 5 },
    openTransport: memory.open,
  })
  ends.push(() => client.close())
  return { client, asked }
}

test('goes to the station of the client, which answers', async () => {
  const { client, asked } = clientOf({ '05FFGW01': '\x0605FF' })
  await client.control.globalSignal(true)
  expect(asked).toEqual(['<ENQ>05FFGW01'])
})

test('goes to all, and is done when it is sent and nobody answers', async () => {
  const { client, asked } = clientOf({})
  await client.control.globalSignal(false, { to: 'all' })
  expect(asked).toEqual(['<ENQ>FFFFGW00'])
  expect(client.statistics.timeouts).toBe(0)
})

test('is answered by whichever station does, where the option says so', async () => {
  const { client } = clientOf({ FFFFGW01: '\x0605FF' }, { answeredToAll: true })
  await client.control.globalSignal(true, { to: 'all' })
  const silent = clientOf({}, { answeredToAll: true })
  await expect(silent.client.control.globalSignal(true, { to: 'all' })).rejects.toMatchObject({ outcome: 'unknown' })
})
