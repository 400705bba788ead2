// Likely causes in the language of the runtime. The library says them in English; the English catalogue has its sentences,
// so that one is found by what it says. What the catalogue does not have stays English.
import { languageOf, type Texts } from './texts'

/** Keys of `cause` in the connection's catalogue, and what stands in their sentences. */
const CAUSES = {
  portAscii: [],
  portBinary: [],
  udpPeer: [],
  udpPeerPort: ['port'],
  otherPort: ['port'],
  frame3E: [],
  frame4E: [],
  frameExt: [],
  frame1E: [],
  frame1C: [],
  frame3C: [],
  frame4C: [],
  route: ['network', 'station'],
  slow: [],
  probe: ['asked'],
  off: [],
  longer: [],
  portChanged: [],
  request: [],
  selfTest: [],
  serialProtocol: [],
  serialSpeed: ['rate'],
  serialCharacters: ['short'],
  serialStation: ['station'],
  serialFormat: ['format'],
  serialNoSum: [],
  serialSum: [],
  serialWires: [],
  serialConverter: [],
  serialOff: [],
  serialSlow: [],
  serialLonger: [],
  serialServer: [],
  serialOthers: [],
  serialChanged: [],
  jwHeader: ['other'],
  jwPeer: [],
  jwPeerPort: ['port'],
  jwPort: ['port', 'other'],
  jwRelay: [],
  jwChanged: [],
  jwProbe: ['asked'],
  portNumber: [],
  notTcp: [],
  notUdp: [],
  allTaken: [],
  restartingTcp: [],
  restartingUdp: [],
  settingsChanged: [],
  programEnded: [],
  unplugged: [],
  wrongAddress: [],
  wrongMask: [],
  switchOff: [],
  networkChanged: [],
  firewallDrops: [],
  misspelt: [],
  nameServer: [],
  ownFirewall: [],
  broadcast: [],
  leftOpen: [],
  fileLimit: [],
} as const satisfies Readonly<Record<string, readonly string[]>>

/** No text has it. */
const PLACE = '\u{1}'

/** The causes of an error of the library. */
export function causesIn(causes: readonly string[], texts: Texts): readonly string[] {
  return languageOf(texts) === 'en-US' ? causes : causes.map((cause) => translated(cause, texts) ?? cause)
}

function translated(cause: string, texts: Texts): string | undefined {
  for (const [key, names] of Object.entries<readonly string[]>(CAUSES)) {
    const places = Object.fromEntries(names.map((name) => [name, PLACE]))
    const english = texts(`cause.${key}`, { ...places, lng: 'en-US' })
    const found = new RegExp(`^${english.replace(/[\\^$.*+?()[\]{}|]/g, '\\$&').replaceAll(PLACE, '(.+?)')}$`).exec(
      cause,
    )
    if (found !== null)
      return texts(`cause.${key}`, Object.fromEntries(names.map((name, at) => [name, found[at + 1] ?? ''])))
  }
  return undefined
}

/** What stands before the causes in messages of the library. */
const HEADING = /\s(?:Likely|Most likely|Possible causes):(?:\s|$)/

/**
 * The message of an error of the library, with its causes in the language of the runtime.
 * @param causes as the library says them
 */
export function messageWith(message: string, causes: readonly string[], texts: Texts): string {
  if (languageOf(texts) === 'en-US') return message
  const told = causesIn(causes, texts)
  const translated = causes.reduce((text, cause, at) => text.replaceAll(cause, () => told[at] ?? cause), message)
  return translated.replace(HEADING, () => ` ${texts('test.causes')} `)
}

/** The message of an error without its causes, for where these are listed below it. */
export function withoutCauses(message: string, causes: readonly string[], texts: Texts): string {
  if (causes.length === 0) return message
  const starts = [message.search(HEADING), message.indexOf(` ${texts('test.causes')}`)].filter((at) => at > 0)
  if (starts.length > 0) return message.slice(0, Math.min(...starts))
  return causes.reduce((text, cause) => text.replace(` ${cause}`, ''), message)
}
