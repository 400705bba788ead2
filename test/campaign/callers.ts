/** What programs do with a client: many calls at once, deadlines, signals, closing. Each is one scene of a lane. */
import type { Random } from '../fuzz/random'
import type { Client, Options } from './calls'
import { QUEUE_LIMIT, TIMEOUT } from './configurations'
import type { Plc } from './plc'

/** What a lane lends to its scenes. */
export interface Stage {
  readonly random: Random
  readonly plc: Plc
  readonly client: Client
  /** Makes a call and starts it. Resolves when it has ended, however it did. */
  call(options?: Options): Promise<void>
  /** Closes the client and makes another one. */
  renew(): Promise<void>
  /** A call that is refused before anything is sent. */
  badCall(): Promise<void>
  sleep(ms: number): Promise<void>
}

export interface Caller {
  readonly name: string
  readonly play: (stage: Stage) => Promise<unknown>
}

function times<T>(count: number, make: (i: number) => T): T[] {
  return Array.from({ length: count }, (_, i) => make(i))
}

const turn = (): Promise<void> => new Promise((resolve) => setImmediate(resolve))

/** Some moment within the same turn of the event loop, or just after it. */
async function moment(kind: number): Promise<void> {
  if (kind === 1) await Promise.resolve()
  if (kind === 2) await turn()
  if (kind === 3) {
    await turn()
    await turn()
  }
}

export const callers: readonly Caller[] = [
  { name: 'one call', play: (stage) => stage.call() },
  { name: 'several calls', play: (stage) => Promise.all(times(2 + stage.random.below(4), () => stage.call())) },
  {
    name: 'one after another',
    play: async (stage) => {
      for (let i = 0; i < 3; i += 1) await stage.call()
    },
  },
  {
    name: 'a call in the end of another',
    play: (stage) => {
      const next = (): Promise<void> => stage.call()
      return Promise.all([stage.call().then(next), stage.call(), stage.call().then(next)])
    },
  },
  {
    name: 'aborted before it begins',
    play: (stage) => Promise.all([stage.call({ signal: AbortSignal.abort() }), stage.call()]),
  },
  {
    name: 'signals of their own, in the turn of the call',
    play: async (stage) => {
      const controllers = times(2 + stage.random.below(3), () => new AbortController())
      const which = stage.random.next()
      const calls = controllers.map(({ signal }) => stage.call({ signal }))
      controllers.forEach((controller, i) => {
        if (((which >> i) & 1) === 1) controller.abort()
      })
      return Promise.all(calls)
    },
  },
  {
    name: 'several ended by one signal in one turn',
    play: async (stage) => {
      const { random } = stage
      const [before, ended, after, when] = [random.below(2), 2 + random.below(2), random.below(3), random.below(4)]
      const controller = new AbortController()
      const { signal } = controller
      const calls = [
        ...times(before, () => stage.call()),
        ...times(ended, () => stage.call({ signal })),
        ...times(after, () => stage.call()),
      ]
      await moment(when)
      controller.abort()
      return Promise.all([...calls, stage.call()])
    },
  },
  {
    name: 'aborted in flight',
    play: async (stage) => {
      const controller = new AbortController()
      const [ms, more] = [1 + stage.random.below(10), stage.random.below(2)]
      const calls = [stage.call({ signal: controller.signal }), ...times(more, () => stage.call())]
      await stage.sleep(ms)
      controller.abort()
      return Promise.all(calls)
    },
  },
  {
    name: 'aborted as it arrives',
    play: (stage) => {
      const controller = new AbortController()
      stage.plc.onReceived = () => controller.abort()
      return Promise.all([stage.call({ signal: controller.signal }), stage.call()])
    },
  },
  {
    name: 'aborted as it is answered',
    play: (stage) => {
      const controller = new AbortController()
      stage.plc.onAnswered = () => controller.abort()
      return Promise.all([stage.call({ signal: controller.signal }), stage.call()])
    },
  },
  {
    name: 'aborted, and another at once',
    play: async (stage) => {
      const controller = new AbortController()
      const when = stage.random.below(4)
      const first = stage.call({ signal: controller.signal })
      await moment(when)
      controller.abort()
      return Promise.all([first, stage.call(), stage.call()])
    },
  },
  {
    name: 'aborted in the end of another',
    play: (stage) => {
      const controller = new AbortController()
      const { signal } = controller
      const first = stage.call().then(() => {
        controller.abort()
        return stage.call()
      })
      return Promise.all([first, stage.call({ signal }), stage.call({ signal })])
    },
  },
  {
    name: 'aborted by a listener',
    play: async (stage) => {
      const controller = new AbortController()
      const stop = stage.client.on('state', () => controller.abort())
      await Promise.all([
        stage.call({ signal: controller.signal }),
        stage.call(),
        stage.call({ signal: controller.signal }),
      ])
      stop()
    },
  },
  {
    name: 'short timeout',
    play: (stage) => Promise.all([stage.call({ timeout: 1 + stage.random.below(6) }), stage.call()]),
  },
  {
    name: 'deadlines in the queue',
    play: (stage) => Promise.all(times(4, (i) => stage.call({ timeout: 2 + stage.random.below(6) + 3 * i }))),
  },
  {
    name: 'signal with a timeout',
    play: (stage) => {
      const signal = AbortSignal.timeout(1 + stage.random.below(TIMEOUT / 2))
      return Promise.all([stage.call({ signal }), stage.call({ signal }), stage.call()])
    },
  },
  {
    name: 'closed in flight',
    play: async (stage) => {
      const [count, when] = [1 + stage.random.below(3), stage.random.below(5)]
      const calls = times(count, () => stage.call())
      if (when === 4) await stage.sleep(3)
      else await moment(when)
      const renewed = stage.renew()
      return Promise.all([...calls, renewed])
    },
  },
  {
    name: 'a new client, and a signal at once',
    play: async (stage) => {
      await stage.renew()
      const controller = new AbortController()
      const [when, which] = [stage.random.below(4), stage.random.below(4)]
      const calls = times(4, (i) => stage.call(i === which ? {} : { signal: controller.signal }))
      await moment(when)
      controller.abort()
      return Promise.all([...calls, stage.call()])
    },
  },
  { name: 'more than the queue takes', play: (stage) => Promise.all(times(QUEUE_LIMIT + 4, () => stage.call())) },
  { name: 'calls that cannot be', play: (stage) => Promise.all([stage.call(), stage.badCall(), stage.call()]) },
  {
    name: 'connecting is aborted',
    play: async (stage) => {
      await stage.renew()
      const controller = new AbortController()
      const when = stage.random.below(4)
      const connecting = stage.client.connect({ signal: controller.signal }).catch(() => {})
      const call = stage.call()
      await moment(when)
      controller.abort()
      return Promise.all([connecting, call, stage.call()])
    },
  },
]
