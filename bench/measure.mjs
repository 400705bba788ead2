// Timing that survives a noisy machine: several rounds, the alternatives in turn within each, medians quoted.

/** Median of numbers. */
export function median(values) {
  const sorted = [...values].sort((a, b) => a - b)
  return sorted[Math.floor(sorted.length / 2)]
}

/** Nanoseconds per call of a synchronous function: the median of `rounds`, each long enough for the clock. */
export function nanosPerCall(run, { rounds = 15, milliseconds = 40 } = {}) {
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
export async function costPerCall(run, calls) {
  const cpu = process.cpuUsage()
  const start = process.hrtime.bigint()
  for (let i = 0; i < calls; i++) await run()
  const wall = Number(process.hrtime.bigint() - start) / 1000 / calls
  const used = process.cpuUsage(cpu)
  return { cpu: (used.user + used.system) / calls, wall }
}

/** Runs alternatives in turn, `rounds` times, and gives the median cost of each. */
export async function compare(alternatives, { rounds = 9, calls = 2000 } = {}) {
  const costs = Object.fromEntries(Object.keys(alternatives).map((name) => [name, { cpu: [], wall: [] }]))
  for (const run of Object.values(alternatives)) await costPerCall(run, calls)
  for (let round = 0; round < rounds; round++) {
    for (const [name, run] of Object.entries(alternatives)) {
      const cost = await costPerCall(run, calls)
      costs[name].cpu.push(cost.cpu)
      costs[name].wall.push(cost.wall)
    }
  }
  return Object.fromEntries(
    Object.entries(costs).map(([name, { cpu, wall }]) => [name, { cpu: median(cpu), wall: median(wall) }]),
  )
}

export function row(name, ...cells) {
  console.log(`${name.padEnd(52)} ${cells.map((cell) => String(cell).padStart(16)).join(' ')}`)
}

export function title(text, ...columns) {
  console.log(`\n${text}`)
  row('', ...columns)
}
