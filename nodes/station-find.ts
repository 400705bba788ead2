/**
 * Which stations of a serial line answer. Each is asked once, with a read of D0, which every device knows; one that answers is
 * asked who it is. Nothing else is sent. A station that is not there costs the answer time of the line. Others who use the line go
 * on between the questions.
 */
import {
  type CallOptions,
  createMelsecClient,
  type MelsecClient,
  type MelsecClientOptions,
  type MelsecLine,
  type MelsecOptions,
  PlcError,
  type PlcOnLine,
  type ProfileId,
  profileIds,
  profiles,
} from '../src/index'

/** A station that answered, with what the CPU said of itself. */
export interface AnsweringStation {
  readonly station: number
  readonly model?: string
  readonly profile?: ProfileId
}

/** @throws PlcError when the line cannot be opened */
export async function answeringStations(options: MelsecClientOptions, over: AbortSignal): Promise<AnsweringStation[]> {
  const { line, profile } = options
  if (line === undefined) return []
  const { serial } = typeof profile === 'string' ? profiles[profile] : (profile ?? profiles['fx5-serial'])
  const answering: AnsweringStation[] = []
  const holder = createMelsecClient({ ...askedBy(options, line), probe: 'none' })
  try {
    // It opens the line, asks nobody, and keeps it open between the questions.
    await holder.connect({ signal: over })
    for (let station = 0; station <= (serial?.lastStation ?? 0) && !over.aborted; station++) {
      const found = await askStation({ ...askedBy(options, line), route: { station } }, over)
      if (found !== undefined) answering.push({ station, ...found })
    }
  } finally {
    await holder.close()
  }
  return answering
}

function askedBy({ profile, messageWait }: MelsecClientOptions, line: MelsecLine): MelsecOptions & PlcOnLine {
  return {
    line,
    ...(profile === undefined ? {} : { profile }),
    ...(messageWait === undefined ? {} : { messageWait }),
  }
}

async function askStation(
  options: MelsecOptions & PlcOnLine,
  signal: AbortSignal,
): Promise<Omit<AnsweringStation, 'station'> | undefined> {
  const client = createMelsecClient({ ...options, probe: 'read' })
  try {
    await client.connect({ signal })
    return await whoIs(client, { signal })
  } catch (error) {
    if (error instanceof PlcError) return undefined
    throw error
  } finally {
    await client.close()
  }
}

/** That it answered is enough. */
async function whoIs(client: MelsecClient, call: CallOptions): Promise<Pick<AnsweringStation, 'model' | 'profile'>> {
  try {
    const { model, profile } = await client.identify(call)
    const own = profileOnLine(profile)
    return { ...(model === '' ? {} : { model }), ...(own === undefined ? {} : { profile: own }) }
  } catch (error) {
    if (error instanceof PlcError) return {}
    throw error
  }
}

/** The CPU tells its family; this is what it is by a serial line. */
export function profileOnLine(profile: ProfileId | undefined): ProfileId | undefined {
  if (profile === undefined) return undefined
  const { cpu } = profiles[profile]
  return profileIds.find((id) => profiles[id].serial !== undefined && profiles[id].cpu === cpu)
}
