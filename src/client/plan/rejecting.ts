/**
 * What is thrown before there is a promise becomes what the promise rejects with. An async function does the same, but who
 * awaits it waits for up to three turns of the queue of promises more, with each call.
 */
export function rejecting<T>(run: () => Promise<T>): Promise<T> {
  try {
    return run()
  } catch (error) {
    return Promise.reject(error)
  }
}
