/** Clients that break their word on purpose: what the campaign must find. */
import { type PlcError, TimeoutError } from '../../src/index'
import type { Client } from './calls'

/** The real client, but for what a double does otherwise. */
function delegate(client: Client, other: Partial<Client>): Client {
  return {
    connect: (...given) => client.connect(...given),
    close: (...given) => client.close(...given),
    read: client.read.bind(client),
    write: client.write.bind(client),
    plan: (...given) => client.plan(...given),
    planWrite: (...given) => client.planWrite(...given),
    selfTest: (...given) => client.selfTest(...given),
    on: (...given) => client.on(...given),
    get state() {
      return client.state
    },
    get statistics() {
      return client.statistics
    },
    ...other,
  }
}

// The methods of a client have many forms; the campaign uses one of them.
type Read = (item: string, options?: { readonly timeout?: number; readonly signal?: AbortSignal }) => Promise<unknown>
type Write = (item: string, value: unknown, options?: { readonly timeout?: number }) => Promise<void>

function reading(client: Client, read: (real: Read) => Read): Client {
  return delegate(client, { read: read(client.read.bind(client) as Read) as Client['read'] })
}

function writing(client: Client, write: (real: Write) => Write): Client {
  return delegate(client, { write: write(client.write.bind(client) as Write) as Client['write'] })
}

/** Gives every read of a word the value of the one before it. */
export function mixesUpValues(client: Client): Client {
  let before: unknown
  return reading(client, (real) => async (item, options) => {
    const value = await real(item, options)
    if (typeof value !== 'number') return value
    const given = before ?? value
    before = value
    return given
  })
}

/** Remembers what it read from an item once. */
export function givesOldValues(client: Client): Client {
  const known = new Map<string, unknown>()
  return reading(client, (real) => async (item, options) => {
    if (!known.has(item)) known.set(item, await real(item, options))
    return known.get(item)
  })
}

/** Gives the value that a register usually has, without asking. */
export function makesValuesUp(client: Client): Client {
  return reading(client, (real) => async (item, options) => {
    const [, number] = /^D(\d+):WORD$/.exec(item) ?? []
    return number === undefined ? real(item, options) : Number(number) * 64
  })
}

/** Says that a write was not sent although it was carried out. */
export function deniesWrites(client: Client): Client {
  return writing(client, (real) => async (item, value, options) => {
    await real(item, value, options)
    throw new TimeoutError('was not sent', 'notSent')
  })
}

/** Repeats a write when nobody knows what became of it. */
export function repeatsWrites(client: Client): Client {
  return writing(
    client,
    (real) => (item, value, options) =>
      real(item, value, options).catch((error: PlcError) => {
        if (error.outcome !== 'unknown') throw error
        return client.connect({ timeout: 500 }).then(() => real(item, value))
      }),
  )
}

/** Says that a write is done whatever became of it. */
export function hidesFailures(client: Client): Client {
  return writing(client, (real) => (item, value, options) => real(item, value, options).catch(() => {}))
}

/** Throws what is no error of this package. */
export function throwsAnything(client: Client): Client {
  return writing(
    client,
    (real) => (item, value, options) =>
      real(item, value, options).catch((error: PlcError) => {
        throw new Error(error.message)
      }),
  )
}
