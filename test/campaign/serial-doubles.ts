/** Clients on a serial line that break their word on purpose: what the campaign must find. */
import type { MelsecClient, PlcError } from '../../src/index'
import type { Transport, TransportHandlers } from '../../src/transport/transport'
import { isThere, type SerialDouble } from './serial-lane'

// The methods of a client have many forms.
type Write = (...given: readonly unknown[]) => Promise<void>

/** Writes again when no answer came. */
export const repeatsAfterSilence: SerialDouble = {
  name: 'repeats a write after silence',
  requests: 120,
  client: (client) => {
    const real = client.write.bind(client) as Write
    const write: Write = (...given) =>
      real(...given).catch((error: PlcError) => {
        if (error.outcome !== 'unknown') throw error
        return isThere(client).then(() => real(...given))
      })
    return {
      read: client.read.bind(client),
      readValues: client.readValues.bind(client),
      write: write as MelsecClient['write'],
    }
  },
}

const [STX, ETX, ACK, NAK] = [2, 3, 6, 0x15]
/** 3C: behind the start code and the frame ID. */
const STATION = { from: 3, to: 5 }

/** Neither ends what the PLC was asked, nor waits until it has been silent, nor looks whose answer it is. */
export const takesLateAnswers: SerialDouble = {
  name: 'takes late answers for the next ones',
  isSimple: true,
  share: 0.02,
  requests: 800,
  times: { answerTime: 60, quiet: 1, gap: 0 },
  transport: (open) => () => {
    let asked: Uint8Array = Buffer.alloc(0)
    return changed(open(), {
      sends: (bytes) => {
        if (bytes.length > 4) asked = bytes
        return bytes.length > 4
      },
      received: (bytes) => {
        if (![STX, ACK, NAK].includes(bytes[0] ?? 0)) return bytes
        const its = Buffer.from(bytes)
        its.set(asked.subarray(STATION.from, STATION.to), STATION.from)
        return withRightSum(its)
      },
    })
  },
}

/** Takes answers with any sum. */
export const ignoresTheSum: SerialDouble = {
  name: 'ignores the sum check code',
  requests: 250,
  transport: (open) => () => changed(open(), { received: withRightSum }),
}

/** Formats 1 and 4: the sum of what stands behind STX, ETX included. */
function withRightSum(bytes: Buffer): Buffer {
  const [begin, end] = [bytes.indexOf(STX), bytes.lastIndexOf(ETX)]
  if (begin < 0 || end < begin || bytes.length < end + 3) return bytes
  const sum = bytes.subarray(begin + 1, end + 1).reduce((total, byte) => (total + byte) & 255, 0)
  const right = Buffer.from(bytes)
  right.write(sum.toString(16).toUpperCase().padStart(2, '0'), end + 1, 'latin1')
  return right
}

/** A transport that does not send everything, or brings something else. */
function changed(
  transport: Transport,
  { sends = () => true, received = (bytes) => bytes }: Partial<Changes>,
): Transport {
  return {
    kind: transport.kind,
    renewable: transport.renewable,
    get ready() {
      return transport.ready
    },
    get description() {
      return transport.description
    },
    open(handlers: TransportHandlers) {
      transport.open({
        opened: () => handlers.opened(),
        received: (bytes) => handlers.received(received(bytes)),
        closed: (error) => handlers.closed(error),
      })
    },
    send: (bytes) => {
      if (sends(bytes)) transport.send(bytes)
    },
    renew: () => transport.renew(),
    close: () => transport.close(),
  }
}

interface Changes {
  readonly sends: (bytes: Uint8Array) => boolean
  readonly received: (bytes: Buffer) => Buffer
}
