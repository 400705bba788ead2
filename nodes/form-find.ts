/**
 * In which frame, message format and with or without sum check code a station of a serial line answers. Each is tried with a read
 * of D0, on a line of its own: only where nobody else uses the port. Nothing else is sent.
 */
import {
  ConnectionError,
  createMelsecClient,
  createMelsecLine,
  type MelsecClientOptions,
  type MelsecLine,
  type MelsecLineOptions,
  PlcError,
  profiles,
  type SerialFormat,
  type SerialFrameName,
  serialFrameNames,
} from '../src/index'
import { pause } from './connection-find'
import { LINE_PROFILE } from './connection-settings'

/** A way to speak that was answered. */
export interface AnsweringForm {
  readonly frame: SerialFrameName
  readonly messageFormat: SerialFormat
  readonly sumCheck: boolean
}

/** @param line as it is set, and got no answer */
export async function answeringForms(
  options: MelsecClientOptions,
  line: MelsecLineOptions,
  over: AbortSignal,
): Promise<AnsweringForm[]> {
  const answering: AnsweringForm[] = []
  for (const form of forms()) {
    if (over.aborted) break
    const other = lineIn(form, line)
    if (other !== undefined && (await answers(options, other, over))) answering.push(form)
  }
  return answering
}

function forms(): AnsweringForm[] {
  return serialFrameNames.flatMap((frame) =>
    ([1, 4, 5] as const).flatMap((messageFormat) =>
      [true, false].map((sumCheck) => ({ frame, messageFormat, sumCheck })),
    ),
  )
}

/** None where the frame lacks the format, or the characters are too short for it. */
function lineIn(form: AnsweringForm, line: MelsecLineOptions): MelsecLine | undefined {
  try {
    return createMelsecLine({ ...line, ...form })
  } catch (error) {
    if (error instanceof PlcError) return undefined
    throw error
  }
}

/** A deployed connection that gets no answer opens the port again and again: it is waited for. */
const TRIES = 8
const PAUSE = 300

async function answers(options: MelsecClientOptions, line: MelsecLine, signal: AbortSignal): Promise<boolean> {
  for (let tries = 1; ; tries++) {
    try {
      return await asks(options, line, signal)
    } catch (error) {
      if (!(error instanceof ConnectionError) || error.code !== 'PORT_UNAVAILABLE' || tries === TRIES) throw error
      await pause(PAUSE)
    }
  }
}

/** A refusal is no answer: it may be the sum or the form that the PLC refuses. */
async function asks({ profile, route }: MelsecClientOptions, line: MelsecLine, signal: AbortSignal): Promise<boolean> {
  const knows = typeof profile === 'string' && profiles[profile].frames.includes(line.frame)
  const client = createMelsecClient({
    line,
    profile: knows ? profile : LINE_PROFILE,
    route: { station: route?.station ?? 0 },
    probe: 'read',
  })
  try {
    await client.connect({ signal })
    await client.read('D0', { signal })
    return true
  } catch (error) {
    if (error instanceof PlcError && error.code !== 'PORT_UNAVAILABLE') return false
    throw error
  } finally {
    await client.close()
  }
}
