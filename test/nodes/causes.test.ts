/** Likely causes: the catalogues have every one that the library can name, and English is as the library says it. */
import { describe, expect, test } from '@jest/globals'
import { causesIn, messageWith, withoutCauses } from '../../nodes/causes'
import type { Texts } from '../../nodes/texts'
import * as failure from '../../src/client/connection/failure'
import { explainJwSilence } from '../../src/client/jw/diagnosis'
import { explainSilence, type LinkSettings } from '../../src/client/melsec/diagnosis'
import { ethernetFrameNames, serialFrameNames } from '../../src/index'
import { serialSettings } from '../../src/transport/serial'
import { nodesOf, parseTypeScript, readText, textOf } from '../support/syntax'

type Catalogue = { readonly language: string; readonly [part: string]: unknown }

/** As Node-RED finds texts. */
function textsIn(language: string): Texts {
  const catalogueOf = (name: string) =>
    JSON.parse(readText(`nodes/locales/${name}/melsec-jw-connection.json`)) as Catalogue
  const own = catalogueOf(language)
  return (key, { lng, ...values } = {}) => {
    const catalogue = lng === undefined ? own : catalogueOf(String(lng))
    const found = key
      .split('.')
      .reduce<unknown>((part, name) => (part as Readonly<Record<string, unknown>>)?.[name], catalogue)
    if (typeof found !== 'string') throw new Error(`there is no text ${key}`)
    return found.replaceAll(/__(\w+)__/g, (_whole, name: string) => String(values[name]))
  }
}

const own = { network: 0, station: 255, moduleIo: 0x3ff, multidrop: 0 }

function silences(): string[] {
  const settings = ethernetFrameNames.flatMap((frame) =>
    (['binary', 'ascii'] as const).flatMap((code) =>
      [own, { ...own, network: 1, station: 3 }].flatMap((route) =>
        [undefined, 5002].map(
          (localPort) => ({ transport: 'udp', port: 5010, frame, code, route, localPort }) as const,
        ),
      ),
    ),
  ) satisfies readonly LinkSettings[]
  const port = serialSettings({ path: 'COM3', baudRate: 19_200 })
  const links = [true, false].map((on) => ({ station: 7, format: 4, sumCheck: on, port, isRemote: on }) as const)
  const serial = serialFrameNames.flatMap((frame) =>
    links.map((link) => ({ transport: 'serial', port: undefined, frame, code: 'ascii', route: own, link }) as const),
  ) satisfies readonly LinkSettings[]
  const peer = 'udp 10.0.0.1:5010'
  return [
    ...[...settings, ...serial].flatMap((each) =>
      explainSilence(each, { peer, answeredBefore: false, onlyAsked: 'Read (0401)' }),
    ),
    ...explainSilence({ ...settings[0], port: 5010 } as LinkSettings, { peer, answeredBefore: true }),
    ...explainSilence(serial[0] as LinkSettings, { peer, answeredBefore: true }),
    ...jwSilences(),
    failure.NO_SELF_TEST,
  ]
}

function jwSilences(): readonly string[] {
  const headers = ['none', 'zero40', { pda: 1, psa: 2, slot: 3, station: 4 }, Uint8Array.of(0)] as const
  const places = [{ port: 5010 }, { port: 5010, localPort: 5002 }]
  const peer = 'udp 10.0.0.1:5010'
  const asked = { peer, answeredBefore: false, onlyAsked: 'Read write mode (E9H)' }
  return headers.flatMap((header) =>
    (['tcp', 'udp'] as const).flatMap((transport) =>
      (['writeMode', 'read'] as const).flatMap((probe) =>
        places.flatMap((place) => [
          ...explainJwSilence({ transport, header, probe }, place, asked),
          ...explainJwSilence({ transport, header, probe }, place, { peer, answeredBefore: true }),
        ]),
      ),
    ),
  )
}

const NAMES = ['causes', 'afterItAnswered', 'NETWORK_CHANGED', 'CHANGED']

/** The texts in lists of causes of a source file. */
function listed(path: string): string[] {
  const lists = [...nodesOf(parseTypeScript(readText(path)))].flatMap(({ key, id, value, init }) =>
    NAMES.includes(textOf(key) ?? textOf(id) ?? '') ? [value ?? init] : [],
  )
  return [...nodesOf(lists)].flatMap((node) => (node.type === 'StringLiteral' ? [textOf(node) ?? ''] : []))
}

const all = [
  ...new Set([...silences(), ...listed('src/transport/failure.ts'), ...listed('src/client/connection/failure.ts')]),
]

test('the causes of the library were found', () => {
  expect(all).toContain('a switch or router on the way is off')
  expect(all).toContain('an address or a firewall was changed since it last answered')
  expect(all.length).toBeGreaterThan(35)
})

describe.each(['ja', 'zh-CN', 'zh-TW'])('in %s', (language) => {
  const texts = textsIn(language)

  test.each(all)('%s', (cause) => {
    const [told] = causesIn([cause], texts)
    expect(told).toMatch(/[\u3040-\u30ff\u4e00-\u9fff]/)
    expect(told).not.toMatch(/undefined|__/)
    // Numbers that are not part of a name are the same.
    for (const number of cause.match(/\b(?:5010|5002|0401|19200|7O1)\b/g) ?? []) expect(told).toContain(number)
  })
})

describe('a message', () => {
  const causes = explainSilence(
    { transport: 'tcp', port: 5010, frame: '4E', code: 'binary', route: own },
    {
      peer: 'tcp plc:5010',
      answeredBefore: false,
    },
  )
  const silent = failure.silent('tcp plc:5010', causes, failure.noAnswer('Read', 'tcp plc:5010', causes), [
    'Read (0401)',
  ])
  const late = failure.noAnswer('Read', 'tcp plc:5010', causes)

  test('in English is as the library says it', () => {
    const texts = textsIn('en-US')
    expect(messageWith(silent.message, causes, texts)).toBe(silent.message)
    expect(causesIn(causes, texts)).toBe(causes)
  })

  test('has its causes in the language of the runtime, as many as it had', () => {
    const texts = textsIn('ja')
    const told = causesIn(causes, texts)
    const message = messageWith(silent.message, causes, texts)
    for (const cause of told) expect(message).toContain(cause)
    expect(message).toMatch(/^tcp plc:5010 does not answer Read \(0401\)\. 考えられる原因/)
    expect(messageWith(late.message, causes, texts)).toBe(
      `Read: no answer from tcp plc:5010 before the deadline. 考えられる原因(可能性の高い順): ${told[0]}`,
    )
  })

  test.each(['en-US', 'ja'])('can be had without them in %s', (language) => {
    const texts = textsIn(language)
    for (const { message } of [silent, late, failure.connectTimedOut('tcp plc:5010', 100)]) {
      const given = message.includes('accept') ? failure.connectTimedOut('', 1).causes : causes
      const short = withoutCauses(messageWith(message, given, texts), causesIn(given, texts), texts)
      expect(short).toMatch(/(?:does not answer Read \(0401\)|before the deadline|within 100 ms)\.$/)
    }
  })

  test('keeps what it does not know', () => {
    expect(causesIn(['something new'], textsIn('ja'))).toEqual(['something new'])
  })
})
