/** Tells a listener, whose mistakes must not stop the connection; whoever registered it reports them. */
export function tellListener<T>(listener: (event: T) => void, event: T): void {
  try {
    listener(event)
  } catch {
    // MelsecClient catches and reports what its own listeners throw.
  }
}
