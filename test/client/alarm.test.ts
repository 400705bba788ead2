// The one timer of a connection, with a clock that rings when it is told to.
import { describe, expect, test } from '@jest/globals'
import { Alarm } from '../../src/client/connection/alarm'
import { manualClock } from '../support/manual-clock'

function bench() {
  const rings: number[] = []
  let now = 0
  const timers: { ms: number; run: () => void }[] = []
  const clock = {
    now: () => now,
    time: () => now,
    timer(ms: number, run: () => void) {
      const timer = { ms, run }
      timers.push(timer)
      return () => void timers.splice(timers.indexOf(timer), 1)
    },
  }
  const alarm = new Alarm(clock, () => rings.push(now))
  /** The latest timer runs, at a time of the test's choice. */
  const runAt = (time: number) => {
    now = time
    timers.shift()?.run()
  }
  return { alarm, rings, timers, runAt, waits: () => timers.map(({ ms }) => ms) }
}

describe('one timer for everything', () => {
  test('nothing due, no timer', () => {
    const { alarm, timers } = bench()
    alarm.set(Number.POSITIVE_INFINITY)
    expect(timers).toEqual([])
  })

  test('an earlier time replaces it; a later one leaves it alone', () => {
    const { alarm, rings, waits, runAt } = bench()
    alarm.set(1000)
    for (let due = 1001; due < 1500; due++) alarm.set(due)
    expect(waits()).toEqual([1000])
    alarm.set(400)
    expect(waits()).toEqual([400])
    runAt(400)
    expect([rings, waits()]).toEqual([[400], []])
    alarm.set(1499)
    expect(waits()).toEqual([1099])
  })

  test('what is overdue rings soon, never from inside set', () => {
    const { alarm, rings, waits, runAt } = bench()
    runAt(500)
    alarm.set(100)
    expect([waits(), rings]).toEqual([[0], []])
  })

  test('cancelled it does not ring, and can be set again', () => {
    const clock = manualClock()
    let rings = 0
    const alarm = new Alarm(clock, () => rings++)
    alarm.set(100)
    alarm.cancel()
    alarm.cancel()
    clock.advance(200)
    expect([rings, clock.pending]).toEqual([0, 0])
    alarm.set(300)
    clock.advance(100)
    expect(rings).toBe(1)
  })
})

test('after a stall the sockets are served before anything is found overdue', () => {
  const { alarm, rings, waits, runAt } = bench()
  alarm.set(1000)
  // The program stood still for 2 s: answers may be waiting in the socket.
  runAt(3000)
  expect([rings, waits()]).toEqual([[], [0]])
  // What arrived may have set other deadlines meanwhile; the next look is already planned.
  alarm.set(3500)
  expect(waits()).toEqual([0])
  runAt(3001)
  expect(rings).toEqual([3001])
  alarm.set(3500)
  runAt(3500 + 50)
  expect(rings).toEqual([3001, 3550])
})
