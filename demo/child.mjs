// What both processes of the demo do: tell their parent when they are ready, and end when it says so or is gone.

/** More than this for an orderly end, and it ends anyway. */
const LONGEST_END = 6000

/** @param message what the parent is to know, e.g. `{ ready: … }` */
export function tell(message) {
  // Not connected: started by hand, or the parent is gone.
  if (process.connected) process.send(message, () => {})
}

/**
 * Ends the process in order when the parent asks for it, and when the parent is gone without having asked.
 * @param close an async function that ends everything
 */
export function endWithParent(close) {
  let ending = false
  const end = () => {
    if (ending) return
    ending = true
    setTimeout(() => process.exit(0), LONGEST_END).unref()
    close()
      .catch((error) => console.error(error))
      .finally(() => process.exit(0))
  }
  // These reach every process of a terminal at once: they are left to the parent, which knows the order.
  for (const signal of ['SIGINT', 'SIGHUP', 'SIGBREAK']) process.on(signal, () => process.connected || end())
  process.on('SIGTERM', end)
  process.on('message', (message) => {
    if (message === 'end') end()
  })
  process.on('disconnect', end)
}
