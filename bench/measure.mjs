// Timing that survives a noisy machine: several rounds, the alternatives in turn within each, medians quoted.

/** Everything once, to see that it runs; the figures say nothing then. */
export const isQuick = process.argv.includes('--quick')

/** So many, or 1 where everything is done once. */
export const times = (count) => (isQuick ? 1 : count)

/** Median of numbers. */
export function median(values) {
  const sorted = [...values].sort((a, b) => a - b)
  return sorted[Math.floor(sorted.length / 2)]
}

/** Nanoseconds per call of a synchronous function: the median of `rounds`, each long enough for the clock. */
export function nanosPerCall(run, { rounds = times(9), milliseconds = times(20) } = {}) {
  let calls = 1
  for (;;) {
    const start = process.hrtime.bigint()
    for (let i = 0; i < calls; i++) run()
    if (Number(process.hrtime.bigint() - start) > milliseconds * 1e6) break
    calls *= 2
  }
  const times = []
  for (let round = 0; round < rounds; round++) {
    const start = process.hrtime.bigint()
    for (let i = 0; i < calls; i++) run()
    times.push(Number(process.hrtime.bigint() - start) / calls)
  }
  return median(times)
}

/** Processor microseconds and wall microseconds per call of an asynchronous function, called one after another. */
export async function costPerCall(run, wanted) {
  const calls = times(wanted)
  const cpu = process.cpuUsage()
  const start = process.hrtime.bigint()
  for (let i = 0; i < calls; i++) await run()
  const wall = Number(process.hrtime.bigint() - start) / 1000 / calls
  const used = process.cpuUsage(cpu)
  return { cpu: (used.user + used.system) / calls, wall }
}

/**
 * Runs alternatives in turn, `rounds` times. Costs are medians over the rounds; ratios to the first alternative are
 * medians of the ratios within a round, so that a slow moment of the machine is in both.
 */
export async function compare(alternatives, { rounds = times(21), calls = 1000 } = {}) {
  const entries = Object.entries(alternatives)
  for (const [, run] of entries) await costPerCall(run, 3 * calls)
  const costs = entries.map(() => [])
  for (let round = 0; round < rounds; round++) {
    for (const [i, [, run]] of entries.entries()) costs[i].push(await costPerCall(run, calls))
  }
  const [base] = costs
  const middle = (own, of) => median(own.map(of))
  return Object.fromEntries(
    entries.map(([name], i) => [
      name,
      {
        cpu: middle(costs[i], ({ cpu }) => cpu),
        wall: middle(costs[i], ({ wall }) => wall),
        cpuRatio: middle(costs[i], ({ cpu }, round) => cpu / base[round].cpu),
        speedRatio: middle(costs[i], ({ wall }, round) => base[round].wall / wall),
      },
    ]),
  )
}

export function row(name, ...cells) {
  console.log(`${name.padEnd(52)} ${cells.map((cell) => String(cell).padStart(16)).join(' ')}`)
}

export function title(text, ...columns) {
  console.log(`\n${text}`)
  row('', ...columns)
}
