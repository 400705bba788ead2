// Commands that go on until somebody ends them.

const SIGNALS = ['SIGINT', 'SIGTERM', 'SIGHUP'] as const

/**
 * Waits for Ctrl-C, for another program that asks this one to end, or for `other`.
 * From the call on Ctrl-C no longer ends the process by itself.
 */
export async function interruption(other?: Promise<void>): Promise<void> {
  let interrupted = () => {}
  const happened = new Promise<void>((resolve) => {
    interrupted = resolve
  })
  for (const signal of SIGNALS) process.once(signal, interrupted)
  await Promise.race(other === undefined ? [happened] : [happened, other])
  for (const signal of SIGNALS) process.off(signal, interrupted)
}
