/** States of a connection as a discriminated union: what the type promises by the name holds at run time. */
import { describe, expect, test } from '@jest/globals'
import { Supervisor } from '../../src/client/connection/supervisor'
import { ClosedError, type ConnectionState, type PlcErrorCode } from '../../src/index'
import { Bench } from './bench'

/** Compiles only where the name narrows the type. */
function reasonOf(state: ConnectionState): PlcErrorCode | number | undefined {
  switch (state.name) {
    case 'waiting':
      return state.error.code
    case 'connecting':
    case 'closed': {
      const none: undefined = state.nextAttempt
      // @ts-expect-error there is none where nothing has failed yet
      const surely = () => state.error.code
      return none ?? (state.error === undefined ? state.attempt : surely())
    }
    case 'idle':
    case 'connected': {
      const none: undefined = state.error
      return none ?? state.nextAttempt
    }
    default:
      return state satisfies never
  }
}

/** The names of what a state holds beside what all have. */
const beside = ({ name, since, attempt, ...rest }: ConnectionState) => [name, ...Object.keys(rest)]

describe('each state holds what its name says', () => {
  test('from idle to closed, with an outage between', async () => {
    const bench = new Bench()
    const idle = bench.connection.state
    bench.memory.refuse = true
    bench.follow(bench.connection.connect())
    await bench.settle()
    bench.memory.refuse = false
    await bench.pass(1000)
    bench.plc.peers.at(-1)?.reset()
    await bench.settle()
    bench.connection.close()
    const states = [idle, ...bench.states]
    expect(states.map(beside)).toEqual([
      ['idle'],
      ['connecting'],
      ['waiting', 'error', 'nextAttempt'],
      ['connecting', 'error'],
      ['connected'],
      ['waiting', 'error', 'nextAttempt'],
      ['closed', 'error'],
    ])
    const failed = 'CONNECT_FAILED'
    const lost = 'DISCONNECTED'
    expect(states.map(reasonOf)).toEqual([undefined, 1, failed, failed, undefined, lost, lost])
  })

  test('closed without anything having failed has no error', () => {
    const bench = new Bench()
    bench.connection.close()
    expect(bench.states.map(beside)).toEqual([['closed']])
  })

  test('waiting for a correction by the user has an error and no next attempt', () => {
    const supervisor = new Supervisor({ first: 500, longest: 1000, settleGap: 50, random: () => 0 })
    const error = new ClosedError('CLOSED', 'm', 'unknown')
    supervisor.want()
    supervisor.lost(error, 0, Number.POSITIVE_INFINITY)
    expect([supervisor.phase, supervisor.givenUp]).toEqual([{ name: 'waiting', error }, true])
    expect('nextAttempt' in supervisor.phase).toBe(false)
    supervisor.retry()
    expect(supervisor.phase).toEqual({ name: 'connecting', error })
  })
})
