import { describe, expect, test } from '@jest/globals'
import { type Priority, Scheduler } from '../../src/link/link'

interface Job {
  readonly name: string
  readonly priority?: Priority
  readonly caller?: unknown
  readonly plc?: unknown
  readonly notBefore?: number
}

function schedule(...jobs: Job[]): Scheduler<Job> {
  const scheduler = new Scheduler<Job>()
  for (const job of jobs) scheduler.add(job)
  return scheduler
}

function order(scheduler: Scheduler<Job>): string {
  const names: string[] = []
  for (let job = scheduler.take(0); job !== undefined; job = scheduler.take(0)) names.push(job.name)
  return names.join(' ')
}

const numbered = (letter: string, count: number, facts: Omit<Job, 'name'> = {}): Job[] =>
  Array.from({ length: count }, (_, i) => ({ name: `${letter}${i + 1}`, ...facts }))

describe('the order', () => {
  test('without callers is that of arrival', () => {
    expect(order(schedule(...numbered('r', 5)))).toBe('r1 r2 r3 r4 r5')
  })

  test('control goes before reads, reads before polls', () => {
    const jobs: Job[] = [
      { name: 'poll', priority: 'poll' },
      { name: 'read' },
      { name: 'write', priority: 'control' },
      { name: 'stop', priority: 'control' },
    ]
    expect(order(schedule(...jobs))).toBe('write stop read poll')
  })

  test('writes without end do not starve a read: after eight of them it goes', () => {
    const scheduler = schedule({ name: 'R' }, ...numbered('w', 20, { priority: 'control' }))
    expect(order(scheduler)).toBe('w1 w2 w3 w4 w5 w6 w7 w8 R w9 w10 w11 w12 w13 w14 w15 w16 w17 w18 w19 w20')
  })

  test('what went alone does not count: only a row that others wait behind', () => {
    const scheduler = schedule(...numbered('w', 20, { priority: 'control' }))
    for (let i = 0; i < 12; i++) scheduler.take(0)
    scheduler.add({ name: 'R' })
    expect(order(scheduler)).toBe('w13 w14 w15 w16 w17 w18 w19 w20 R')
  })

  test('reads without end do not starve a poll, nor both of them writes', () => {
    const scheduler = schedule({ name: 'P', priority: 'poll' }, ...numbered('r', 9))
    expect(order(scheduler)).toBe('r1 r2 r3 r4 r5 r6 r7 r8 P r9')
  })

  test('of both, one of each goes after eight writes: a poll waits for nine others at most', () => {
    const scheduler = schedule(
      { name: 'P', priority: 'poll' },
      ...numbered('r', 3),
      ...numbered('w', 20, { priority: 'control' }),
    )
    expect(order(scheduler)).toBe('w1 w2 w3 w4 w5 w6 w7 w8 r1 P w9 w10 w11 w12 w13 w14 w15 w16 r2 w17 w18 w19 w20 r3')
  })

  test('callers take turns, however much one of them asks', () => {
    const scheduler = schedule(
      ...numbered('a', 4, { caller: 'a' }),
      ...numbered('b', 2, { caller: 'b' }),
      ...numbered('c', 1, { caller: 'c' }),
    )
    expect(order(scheduler)).toBe('a1 b1 c1 a2 b2 a3 a4')
  })

  test('a caller that comes later does not wait for what another one has piled up', () => {
    const scheduler = schedule(...numbered('a', 60, { caller: 'a' }))
    for (let i = 0; i < 10; i++) scheduler.take(0)
    scheduler.add({ name: 'new', caller: 'b' })
    scheduler.add({ name: 'nobody' })
    expect([scheduler.take(0), scheduler.take(0), scheduler.take(0)].map((job) => job?.name)).toEqual([
      'a11',
      'new',
      'nobody',
    ])
  })

  test('a caller that was away gets no more than its turn for that', () => {
    const scheduler = schedule(...numbered('a', 1, { caller: 'a' }), ...numbered('b', 50, { caller: 'b' }))
    for (let i = 0; i < 41; i++) scheduler.take(0)
    for (const job of numbered('c', 3, { caller: 'a' })) scheduler.add(job)
    expect(order(scheduler).split(' ').slice(0, 6).join(' ')).toBe('b41 c1 b42 c2 b43 c3')
  })

  test('the same callers asking in the same order, again and again, are served alike', () => {
    const scheduler = new Scheduler<Job>()
    const served = new Map<string, number>()
    // Seven ask in each round, and five of them can be served: nobody is always the last.
    for (let round = 0; round < 70; round++) {
      for (let i = 0; i < 7; i++) scheduler.add({ name: `n${i}`, caller: i })
      for (let i = 0; i < 5; i++) {
        const { name } = scheduler.take(0) ?? { name: '' }
        served.set(name, (served.get(name) ?? 0) + 1)
      }
    }
    expect([...served.values()]).toEqual(Array(7).fill(50))
  })
})

describe('the rest', () => {
  test('peek shows what take gives, and changes nothing', () => {
    const scheduler = schedule({ name: 'R' }, ...numbered('w', 12, { priority: 'control' }))
    while (scheduler.size > 0) {
      const shown = scheduler.peek(0)
      expect(scheduler.peek(0)).toBe(shown)
      expect(scheduler.take(0)).toBe(shown)
    }
    expect([scheduler.peek(0), scheduler.take(0)]).toEqual([undefined, undefined])
  })

  test('a caller keeps its turn when what it asked for first is given up', () => {
    const jobs = numbered('a', 2, { caller: 'a' })
    const scheduler = schedule(...jobs, { name: 'b', caller: 'b' })
    scheduler.remove(jobs[0] as Job)
    expect(order(scheduler)).toBe('a2 b')
  })

  test('one that waits alone is peeked at, listed, held back, given up and joined by others as any', () => {
    const alone: Job = { name: 'alone', caller: 'A', notBefore: 5 }
    const scheduler = schedule(alone)
    expect([scheduler.peek(4), scheduler.take(4)]).toEqual([undefined, undefined])
    expect([scheduler.peek(5), scheduler.due(4), [...scheduler], scheduler.size]).toEqual([alone, 5, [alone], 1])
    expect([scheduler.remove({ name: 'another' }), scheduler.remove(alone), scheduler.size]).toEqual([false, true, 0])
    expect([scheduler.peek(9), scheduler.remove(alone), scheduler.due(4)]).toEqual([undefined, false, undefined])
    scheduler.add(alone)
    for (const job of [{ name: 'behind', caller: 'A' }, { name: 'other' }]) scheduler.add(job)
    expect([scheduler.take(4)?.name, scheduler.take(4)]).toEqual(['other', undefined])
    expect([scheduler.take(5), scheduler.take(5)?.name, scheduler.size]).toEqual([alone, 'behind', 0])
    scheduler.add(alone)
    expect([scheduler.clear(), scheduler.size, scheduler.peek(9)]).toEqual([[alone], 0, undefined])
  })

  test('what is removed does not go; what is not there cannot be removed', () => {
    const [a, b, c] = numbered('r', 3)
    const scheduler = schedule(...([a, b, c] as Job[]))
    expect([scheduler.remove(b as Job), scheduler.remove(b as Job), scheduler.size]).toEqual([true, false, 2])
    expect([...scheduler].map(({ name }) => name)).toEqual(['r1', 'r3'])
    expect(scheduler.clear().map(({ name }) => name)).toEqual(['r1', 'r3'])
    expect(scheduler.size).toBe(0)
  })
})

describe('PLCs that share a line', () => {
  test('take turns, and within each of them its callers', () => {
    const jobs = [
      ...numbered('a', 3, { plc: 1, caller: 'a' }),
      ...numbered('b', 2, { plc: 1, caller: 'b' }),
      ...numbered('c', 2, { plc: 2 }),
    ]
    expect(order(schedule(...jobs))).toBe('a1 c1 b1 c2 a2 b2 a3')
  })
})

describe('what may not go yet', () => {
  test('waits, and what is ready goes ahead, whatever its priority', () => {
    const scheduler = schedule(
      { name: 'W', priority: 'control', notBefore: 10 },
      { name: 'r' },
      { name: 'p', priority: 'poll' },
    )
    expect([scheduler.peek(0)?.name, scheduler.due(0)]).toEqual(['r', 10])
    expect(order(scheduler)).toBe('r p')
    expect([scheduler.size, scheduler.take(9)?.name, scheduler.take(10)?.name]).toEqual([1, undefined, 'W'])
    expect(scheduler.due(10)).toBeUndefined()
  })

  test('holds back what the same caller asked behind it, so that the order stays', () => {
    const scheduler = schedule({ name: 'a1', caller: 'a', notBefore: 10 }, { name: 'a2', caller: 'a' }, { name: 'b' })
    expect(order(scheduler)).toBe('b')
    expect([scheduler.take(10)?.name, scheduler.take(10)?.name]).toEqual(['a1', 'a2'])
  })

  test('does not count as one that a row goes ahead of', () => {
    const scheduler = schedule({ name: 'r', notBefore: 100 }, ...numbered('w', 12, { priority: 'control' }))
    for (let i = 0; i < 10; i++) scheduler.take(0)
    scheduler.add({ name: 'r2' })
    // Ten went, but nobody was kept waiting by them.
    expect(scheduler.take(0)?.name).toBe('w11')
  })
})
