import { ClosedError, ConnectionError, PlcError, ProtocolError, TimeoutError } from '../../errors'

/** A failure of the read before the write: nothing has been written, whatever became of the read. */
export async function beforeWriting<T>(reading: Promise<T>): Promise<T> {
  try {
    return await reading
  } catch (error) {
    throw notWritten(error)
  }
}

function notWritten(error: unknown): unknown {
  if (!(error instanceof PlcError) || error.outcome !== 'unknown') return error
  const message = `Nothing was written, because the word could not be read before: ${error.message}`
  if (error instanceof TimeoutError) return new TimeoutError(message, 'notSent', error.causes)
  if (error instanceof ConnectionError) return new ConnectionError(error.code, message, 'notSent', error, error.causes)
  if (error instanceof ClosedError) return new ClosedError(error.code, message, 'notSent', error)
  return error instanceof ProtocolError ? new ConnectionError('DISCONNECTED', message, 'notSent', error) : error
}
