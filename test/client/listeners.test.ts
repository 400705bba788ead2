/** Listening and no longer listening, and the end of a block that uses a client. */
import { describe, expect, test } from '@jest/globals'
import { createMelsecClient } from '../../src/index'
import { failureOf, nextState, withLine } from './line'

const options = { host: '127.0.0.1', port: 1, profile: 'iq-r' } as const

describe('once and off', () => {
  test('once tells the next event only', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ client }) => {
      const told: string[] = []
      client.once('state', ({ name }) => told.push(name))
      await client.connect()
      expect(told).toEqual(['connecting'])
    }))

  test('once is ended by what it gives, and by off', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ client }) => {
      const told: string[] = []
      const listener = ({ name }: { readonly name: string }) => void told.push(name)
      client.once('state', listener)()
      client.once('state', listener)
      client.off('state', listener)
      await client.connect()
      expect(told).toEqual([])
    }))

  test('off ends one listening of a function that listens twice', () =>
    withLine('tcp 4E binary iq-r', {}, async ({ client }) => {
      let told = 0
      const listener = () => void told++
      client.on('state', listener)
      const stop = client.on('state', listener)
      client.off('state', listener)
      // It has ended this one, so nothing is left for it to end.
      stop()
      const connecting = nextState(client, 'connecting')
      const connected = client.connect()
      await connecting
      expect(told).toBe(1)
      client.off('state', listener)
      await connected
      expect(told).toBe(1)
      client.off('state', listener)
    }))

  test.each(['once', 'off'] as const)('%s of no event or no function is refused', async (method) => {
    const client = createMelsecClient(options)
    const call = client[method].bind(client) as (...given: unknown[]) => unknown
    for (const given of [['sate', () => {}], ['state', undefined], []]) {
      expect(await failureOf(Promise.resolve().then(() => call(...given)))).toMatchObject({
        code: 'BAD_OPTION',
        field: 'event',
        message: expect.stringContaining(`${method}()`),
      })
    }
    await client.close()
  })
})

describe('Symbol.asyncDispose', () => {
  test('is there, and closes the client', async () => {
    expect(typeof Symbol.asyncDispose).toBe('symbol')
    const client = createMelsecClient(options)
    await client[Symbol.asyncDispose]()
    expect(client.state.name).toBe('closed')
    expect(await failureOf(client.read('D0'))).toMatchObject({ code: 'CLOSED' })
  })

  test('`await using`, as TypeScript compiles it, closes the client when the block throws', async () => {
    const client = createMelsecClient(options)
    const block = async () => {
      await using plc = client
      throw new Error(plc.state.name)
    }
    await expect(block()).rejects.toThrow('idle')
    expect(client.state.name).toBe('closed')
  })
})
