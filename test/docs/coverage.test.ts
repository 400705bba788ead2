/** Lists in the documentation against the lists in the code: what is added there must be said here, and the reverse. */
import { describe, expect, test } from '@jest/globals'
import { parse } from 'acorn'
import { parseItem } from '../../src/client/item/item'
import { settleSerialLine } from '../../src/client/melsec/serial-options'
import { settle } from '../../src/client/melsec/settings'
import { explainEndCode } from '../../src/end-code/explain'
import * as address from '../../src/entry/address'
import * as codec from '../../src/entry/codec'
import * as simulator from '../../src/entry/simulator'
import { endCodeAbouts } from '../../src/errors'
import * as library from '../../src/index'
import type { Command } from '../../src/melsec/commands/command'
import { commands } from '../../src/melsec/commands/commands'
import { devices } from '../../src/melsec/device/device'
import { limitsOf } from '../../src/melsec/device/limit'
import { doubtOf, lackOf, profileIds } from '../../src/melsec/profiles/profile'
import { profiles } from '../../src/melsec/profiles/profiles'
import { faultKinds } from '../../src/simulator/fault-kinds'
import { settingsOf } from '../../src/simulator/options'
import { parseType, typeNames, wordsOf } from '../../src/value/value'
import { filesBelow, isNode, nodesOf, parseTypeScript, readText, type SyntaxNode, textOf } from '../support/syntax'
import { codeOf, codeSpansOf, proseOf, tableAfter, tablesAfter } from './markdown'

/** The names in the first column of the table behind a mark. */
function namesIn(page: string, mark: string): string[] {
  return tableAfter(page, mark).map(([cell]) => codeOf(cell) ?? '')
}

/** Names of the members of an interface that are for users. */
function membersOf(path: string, name: string): string[] {
  const internal = [...readText(path).matchAll(/@internal \*\/\n +(?:readonly )?(\w+)/g)].map(([, member]) => member)
  const found = [...nodesOf(parseTypeScript(readText(path)))].find(
    (node) => node.type === 'TsInterfaceDeclaration' && textOf(node.id) === name,
  )
  const body = isNode(found?.body) ? found.body.body : []
  return (Array.isArray(body) ? body : [])
    .flatMap((member: SyntaxNode) => textOf(member.key) ?? [])
    .filter((member) => !internal.includes(member))
}

/** The texts of a union of texts. */
function unionOf(path: string, name: string): string[] {
  const found = [...nodesOf(parseTypeScript(readText(path)))].filter(
    (node) => node.type === 'TsTypeAliasDeclaration' && new RegExp(`^${name}$`).test(textOf(node.id) ?? ''),
  )
  return found.flatMap((alias) =>
    [...nodesOf(alias.typeAnnotation)].flatMap((node) => (node.type === 'StringLiteral' ? (textOf(node) ?? []) : [])),
  )
}

describe('options', () => {
  test('of the client are those in docs/client.md', () => {
    const of = (name: string) => membersOf('src/client/melsec/options.ts', name)
    const own = [...of('MelsecOptions'), ...of('NetworkPlc'), ...of('PlcOnLine')]
    const all = new Set([...own, ...membersOf('src/client/melsec/serial-options.ts', 'SerialLineFormat')])
    expect(namesIn('docs/client.md', 'options: client').sort()).toEqual([...all].sort())
  })

  test('of the client of a Sharp JW are those in docs/jw-client.md', () => {
    const own = membersOf('src/client/jw/options.ts', 'JwClientOptions')
    expect(namesIn('docs/jw-client.md', 'options: jw client').sort()).toEqual(own.sort())
  })

  test('of a serial port are those in docs/client.md, with their defaults', () => {
    const rows = tableAfter('docs/client.md', 'options: serial')
    const transport = membersOf('src/transport/serial.ts', 'SerialOptions')
    const all = new Set([...transport, ...membersOf('src/client/melsec/serial-options.ts', 'SerialPortOptions')])
    expect(rows.map(([name]) => codeOf(name)).sort()).toEqual([...all].sort())
    const { port, recovery } = settleSerialLine({})
    const settings: Readonly<Record<string, unknown>> = { ...port, ...recovery }
    for (const [name, usual] of rows) {
      const text = codeOf(usual)
      if (text !== undefined) expect(`${name} ${text}`).toBe(`${name} ${String(settings[codeOf(name) ?? ''])}`)
    }
  })

  test('of a serial line have the usual times on the page and in the dialog of its node', () => {
    const { recovery } = settleSerialLine({})
    const rows = new Map(tableAfter('docs/nodes/line.md', 'properties').map(([name, , usual]) => [codeOf(name), usual]))
    const dialog = readText('nodes/melsec-jw-line.html')
    for (const name of ['answerTime', 'gap'] as const) {
      expect(`${name} ${rows.get(name)}`).toBe(`${name} ${recovery[name]}`)
      expect(dialog).toContain(`id="node-config-input-${name}" placeholder="${recovery[name]}"`)
    }
  })

  test('of the client have the defaults in docs/client.md', () => {
    const { first, longest, profile, ...settings } = settle({ host: 'plc', port: 5010 })
    const shown = tableAfter('docs/client.md', 'options: client').flatMap(([name, usual, meaning]) => {
      const text = codeOf(usual)
      return text === undefined ? [] : [{ name: codeOf(name) ?? '', text, meaning }]
    })
    const values: Readonly<Record<string, unknown>> = { ...settings, profile: profile.id }
    expect(shown.length).toBeGreaterThan(8)
    for (const { name, text } of shown) {
      const value = values[name]
      expect(`${name} ${text}`).toBe(`${name} ${typeof value === 'object' ? JSON.stringify(value) : String(value)}`)
    }
    expect(proseOf('docs/client.md')).toContain(`{ first: ${first}, longest: ${longest} }`)
  })

  test('of the simulator are those in docs/simulator.md, with their defaults', () => {
    const rows = tableAfter('docs/simulator.md', 'options: simulator')
    expect(rows.map(([name]) => codeOf(name)).sort()).toEqual(
      membersOf('src/simulator/options.ts', 'PlcSimulatorOptions').sort(),
    )
    const settings: Readonly<Record<string, unknown>> = { ...settingsOf({}), profile: settingsOf({}).profile.id }
    for (const [name, usual] of rows) {
      const text = codeOf(usual)
      if (text !== undefined) expect(`${name} ${text}`).toBe(`${name} ${String(settings[codeOf(name) ?? ''])}`)
    }
  })

  test('of a simulated line and its stations are those in docs/simulator.md', () => {
    expect(namesIn('docs/simulator.md', 'options: line simulator').sort()).toEqual(
      membersOf('src/simulator/line-options.ts', 'LineSimulatorOptions').sort(),
    )
    const [, stations = ''] = proseOf('docs/simulator.md').split('### Stations')
    const [named = ''] = stations.split('###')
    const [own = ''] = readText('src/simulator/line-options.ts').match(/(?<=Pick<\s+PlcSimulatorOptions,)[^>]*/) ?? []
    const picked = [...own.matchAll(/'(\w+)'/g)].map(([, name = '']) => name)
    expect(picked.length).toBeGreaterThan(5)
    expect(codeSpansOf(named)).toEqual(
      expect.arrayContaining([...picked, ...membersOf('src/simulator/line-options.ts', 'LineStationOptions')]),
    )
  })

  test('of a profile that users may set are in docs/client.md', () => {
    const named = codeSpansOf(proseOf('docs/client.md').split('### Profile overrides')[1] ?? '')
    expect(named).toEqual(expect.arrayContaining(membersOf('src/melsec/profiles/profile.ts', 'ProfileOverrides')))
  })
})

describe('lists', () => {
  test.each([
    ['@melsec-jw/plc', library],
    ['@melsec-jw/plc/address', address],
    ['@melsec-jw/plc/codec', codec],
    ['@melsec-jw/plc/simulator', simulator],
  ])('what %s exports is in the table of docs/client.md', (name, entry) => {
    const [, rest = ''] = proseOf('docs/client.md').split(`### From \`${name}\`\n`)
    const spans = codeSpansOf(rest.split('\n### ')[0] ?? '')
    expect(Object.keys(entry).filter((exported) => !spans.includes(exported))).toEqual([])
    expect(spans.filter((span) => /^(create|parse|explain|describe)[A-Z]\w*$/.test(span) && !(span in entry))).toEqual(
      [],
    )
  })

  test('of a simulated Sharp JW, its members and events are those in docs/simulator.md', () => {
    const options = tableAfter('docs/simulator.md', 'options: jw simulator').flatMap(([name]) =>
      codeSpansOf(name ?? ''),
    )
    // Time, for tests.
    const declared = membersOf('src/simulator/jw/options.ts', 'JwSimulatorOptions').filter((name) => name !== 'clock')
    expect(options.sort()).toEqual(declared.sort())
    const rows = tableAfter('docs/simulator.md', 'members: jw simulator')
    const members = rows.flatMap(([name]) => codeSpansOf(name ?? '')).map((span) => span.replace(/\(.*/, ''))
    expect(members.sort()).toEqual(membersOf('src/simulator/jw/server.ts', 'JwSimulator').sort())
    const events = rows.find(([member]) => member?.startsWith('`on(') === true)
    expect(codeSpansOf(events?.[1] ?? '').sort()).toEqual(
      membersOf('src/simulator/jw/server.ts', 'JwSimulatorEvents').sort(),
    )
  })

  test('fault kinds and their parameters are those in docs/simulator.md', () => {
    const shown = tableAfter('docs/simulator.md', 'faults').map(([kind, , names]) => [
      codeOf(kind),
      codeSpansOf(names ?? ''),
    ])
    expect(shown).toEqual(Object.entries(faultKinds).map(([kind, { parameters }]) => [kind, Object.keys(parameters)]))
  })

  test('events of the simulator are in docs/simulator.md', () => {
    const row = tableAfter('docs/simulator.md', 'members').find(([member]) => member?.startsWith('`on(') === true)
    expect(codeSpansOf(row?.[1] ?? '').sort()).toEqual(membersOf('src/simulator/server.ts', 'SimulatorEvents').sort())
  })

  test('codes of errors are those in docs/errors.md', () => {
    const rows = [...proseOf('docs/errors.md').matchAll(/^\| `([A-Z_]+)` /gm)].map(([, code]) => code)
    const lists = [...readText('src/errors.ts').matchAll(/^export const [A-Z]+_CODES = \[([^\]]*)\]/gm)]
    const listed = lists.flatMap(([, list = '']) => [...list.matchAll(/'(\w+)'/g)].map(([, code]) => code))
    expect(lists).toHaveLength(4)
    expect([...rows, 'END_CODE'].sort()).toEqual([...listed, ...unionOf('src/errors.ts', '\\w+ErrorCode')].sort())
  })

  test('end codes in docs/errors.md have a text of their own', () => {
    const codes = namesIn('docs/errors.md', 'end codes')
    expect(codes.length).toBeGreaterThan(15)
    expect(
      codes.filter((code) => explainEndCode(Number.parseInt(code, 16), { family: 'slmp' })?.exact !== true),
    ).toEqual([])
  })

  test('what an end code can be about is in docs/errors.md', () => {
    expect(namesIn('docs/errors.md', 'about').sort()).toEqual([...endCodeAbouts].sort())
  })

  test('states of a connection are those in docs/client.md', () => {
    expect(namesIn('docs/client.md', 'states').sort()).toEqual(
      unionOf('src/client/connection/supervisor.ts', 'ConnectionStateName').sort(),
    )
  })

  test('statistics are those in docs/client.md', () => {
    expect(namesIn('docs/client.md', 'statistics').sort()).toEqual(
      membersOf('src/client/connection/statistics.ts', 'Statistics').sort(),
    )
    const spans = codeSpansOf(proseOf('docs/client.md'))
    expect(spans).toEqual(expect.arrayContaining(membersOf('src/client/connection/statistics.ts', 'RoundTrip')))
  })

  test.each([
    ['docs/client.md', '`frame`', library.frameNames],
    ['docs/cli.md', '`--frame <name>`', library.frameNames],
    ['docs/nodes/connection.md', '`frame`', library.ethernetFrameNames],
    ['docs/nodes/line.md', '`frame`', library.serialFrameNames],
    ['docs/client.md', '`transport`', library.transportNames],
    ['docs/nodes/connection.md', '`transport`', library.transportNames.filter((name) => name !== 'serial')],
    ['docs/client.md', '`probe`', library.probeKinds],
    ['docs/cli.md', '`--probe <name>`', library.probeKinds],
    ['docs/nodes/connection.md', '`probe`', library.probeKinds],
    ['docs/nodes/connection.md', '`jwProbe`', library.jwProbeKinds],
    ['docs/nodes/connection.md', '`model`', library.jwModels],
  ])('%s: the row of %s names what it takes', (page, cell, names) => {
    const row = proseOf(page)
      .split('\n')
      .find((line) => line.startsWith(`| ${cell} `))
    expect(codeSpansOf(row ?? '')).toEqual(expect.arrayContaining([...names]))
  })

  test('commands that request() takes are in docs/client.md', () => {
    const [, behind = ''] = proseOf('docs/client.md').split('<!-- commands -->')
    const [sentence = ''] = behind.trim().split('`describeFields')
    expect(
      codeSpansOf(sentence)
        .filter((name) => name in commands)
        .sort(),
    ).toEqual(Object.keys(commands).sort())
  })

  test('commands for the connected station are in docs/client.md', () => {
    const [, behind = ''] = proseOf('docs/client.md').split('<!-- connected -->')
    const [sentence = ''] = behind.split('are for the connected station')
    const connected = Object.values<Command>(commands).filter(({ to }) => to === 'connected')
    expect(codeSpansOf(sentence)).toEqual(expect.arrayContaining(connected.map(({ name }) => name)))
    expect(codeSpansOf(sentence)).toHaveLength(connected.length)
  })

  test('calls of remote control are in docs/client.md', () => {
    const shown = namesIn('docs/client.md', 'control').flatMap((call) => /^control\.(\w+)/.exec(call)?.[1] ?? [])
    expect(shown.sort()).toEqual(membersOf('src/client/melsec/control.ts', 'Control').sort())
  })

  test('rooms and what they may import are in docs/architecture.md as in the test of the architecture', () => {
    const [, block = ''] = readText('test/architecture.test.ts').split('const ROOMS')
    const [table = ''] = block.split('\n}')
    const rules = [...table.matchAll(/^ {2}'?([\w/-]+)'?: \[([^\]]*)\],$/gm)]
    const wanted = rules.map(([, room, names = '']) => [
      room,
      [...names.matchAll(/'([\w/-]+)'/g)].map(([, name]) => name),
    ])
    expect(wanted.length).toBeGreaterThan(8)
    const shown = tableAfter('docs/architecture.md', 'rooms').map(([room, names]) => [
      codeOf(room),
      codeSpansOf(names ?? ''),
    ])
    expect(shown).toEqual(wanted)
  })
})

describe('addresses', () => {
  test('devices are those in docs/addresses.md', () => {
    const units = { bit: 'bit', word: 'word', doubleWord: 'double word' }
    const radices = { 8: 'octal', 10: 'decimal', 16: 'hexadecimal' }
    const wanted = devices.map(({ name, title, unit, radix, octal }) => [
      name,
      title,
      units[unit],
      octal === true ? 'octal or hexadecimal' : radices[radix],
    ])
    const shown = tableAfter('docs/addresses.md', 'devices').map(([name, ...cells]) => [codeOf(name), ...cells])
    expect(shown).toEqual(wanted)
  })

  test('types are those in docs/addresses.md, with their words', () => {
    const rows = tableAfter('docs/addresses.md', 'types')
    expect(rows.map(([type]) => (codeOf(type) ?? '').replace('(n)', ''))).toEqual([...typeNames])
    for (const [type = '', words = ''] of rows) {
      if (!/^\d+$/.test(words)) continue
      expect(`${type} ${words}`).toBe(`${type} ${wordsOf(parseType(codeOf(type) ?? ''))}`)
    }
    expect(wordsOf(parseType('STRING(7)'))).toBe(4)
    expect(wordsOf(parseType('WSTRING(7)'))).toBe(7)
  })

  test.each([8, 16] as const)('spellings are accepted where X and Y have radix %d', (xyRadix) => {
    const items = tablesAfter('docs/addresses.md', `accepted: xyRadix ${xyRadix}`).flat()
    const texts = items.flatMap(([address]) => codeOf(address) ?? [])
    expect(texts.length).toBeGreaterThan(2)
    for (const text of texts) expect(() => parseItem(text, { xyRadix })).not.toThrow()
  })

  test('spellings that are said to be refused are refused', () => {
    const texts = namesIn('docs/addresses.md', 'refused: xyRadix 16')
    expect(texts.length).toBeGreaterThan(10)
    for (const text of texts) expect(() => parseItem(text, { xyRadix: 16 })).toThrow()
  })
})

describe('profiles', () => {
  test('are those in docs/client.md, with frames, monitor and limits', () => {
    const wanted = profileIds.map((id) => {
      const profile = profiles[id]
      const frames = [profile.frame, ...profile.frames.filter((frame) => frame !== profile.frame)].join(', ')
      const commandsOfLimits = ['readWords', 'readBits', 'readRandom'] as const
      const limits = commandsOfLimits.map((name) => limitsOf(profile, name, profile.form, 'binary')[0]?.max ?? '–')
      const monitor = lackOf(profile, 'entryMonitorDevice')
        ? 'no'
        : doubtOf(profile, 'entryMonitorDevice')
          ? 'perhaps'
          : 'yes'
      return [id, frames, monitor, limits.join(', ')]
    })
    const shown = tableAfter('docs/client.md', 'profiles').map(([id, , , ...rest]) => [codeOf(id), ...rest])
    expect(shown).toEqual(wanted)
  })

  test('can what the README says', () => {
    const rows = new Map(tableAfter('README.md', 'support').map(([what = '', ...cells]) => [what, cells]))
    const families = ['iq-r', 'iq-f', 'q', 'l', 'fx3'] as const
    const said = (what: string, answer: (profile: (typeof profiles)[(typeof families)[number]]) => string) =>
      expect([what, rows.get(what)]).toEqual([what, families.map((id) => answer(profiles[id]))])
    const command = (name: keyof typeof commands) => (profile: (typeof profiles)['q']) =>
      lackOf(profile, name) ? 'no' : doubtOf(profile, name) ? 'some ports' : 'yes'
    said('Frames over TCP and UDP', ({ frame, frames }) =>
      [frame, ...frames.filter((name) => name !== frame)].join(', '),
    )
    said('Binary and ASCII code', ({ codes }) => (codes.length === 2 ? 'yes' : 'no'))
    said('Block read and write', command('readBlock'))
    said('Monitor registration', command('entryMonitorDevice'))
    said('Read type name', command('readTypeName'))
    said('Labels by name (`Line1.Speed`)', command('readRandomLabels'))
    said('Files on its drives', command('readDirectory'))
    said('Numbers of X and Y', ({ xyRadix }) => (xyRadix === 8 ? 'octal' : 'hexadecimal'))
    said('Link direct devices (`J1\\W10`)', ({ extensions }) => (extensions.includes('link') ? 'yes' : 'no'))
    said('CPU buffer memory (`U3E0\\HG0`)', ({ extensions }) => (extensions.includes('cpu') ? 'yes' : 'no'))
    said('Long timers and long counters', ({ absentDevices }) => {
      const [timers, counters] = [!absentDevices.includes('LTN'), !absentDevices.includes('LCN')]
      return timers && counters ? 'yes' : counters ? 'counters' : 'no'
    })
  })
})

/** The entries of the `defaults` of a node's definition: the name, and the value where it is a text or a number. */
function settingsOfNode(name: string): (readonly [name: string, usual: string | undefined])[] {
  const scripts = [...readText(`nodes/${name}.html`).matchAll(/<script type="text\/javascript">([\S\s]*?)<\/script>/g)]
  const nodes = scripts.flatMap(([, script = '']) => [...nodesOf(parse(script, { ecmaVersion: 'latest' }))])
  const defaults = nodes.find((node) => node.type === 'Property' && keyOf(node) === 'defaults')?.value
  return entriesOf(defaults).map((entry) => {
    const usual = entriesOf(entry.value).find((part) => keyOf(part) === 'value')?.value
    const text = isNode(usual) && typeof usual.value === 'string' ? usual.value : undefined
    return [keyOf(entry), text] as const
  })
}

function keyOf(entry: SyntaxNode): string {
  return isNode(entry.key) ? String(entry.key.name ?? entry.key.value) : ''
}

function entriesOf(node: unknown): readonly SyntaxNode[] {
  return isNode(node) && Array.isArray(node.properties) ? (node.properties as SyntaxNode[]) : []
}

describe('nodes', () => {
  const names = filesBelow('nodes', '.html')
    .map((path) => /^nodes\/([\w-]+)\.html$/.exec(path)?.[1])
    .filter((name) => name !== undefined)
  const pageOf = (name: string) => `docs/nodes/${name.replace('melsec-jw-', '')}.md`

  test.each(names)('%s: its stored properties are those in its page', (name) => {
    const settings = settingsOfNode(name).map(([setting]) => setting)
    expect(namesIn(pageOf(name), 'properties').sort()).toEqual(settings.sort())
  })

  test.each(names)('%s: its defaults are those in its page', (name) => {
    const shown = new Map(
      tableAfter(pageOf(name), 'properties').map(([setting, , usual]) => [codeOf(setting), codeOf(usual)]),
    )
    const wrong = settingsOfNode(name).filter(([setting, usual]) => {
      const text = shown.get(setting)
      return text !== undefined ? text !== usual : usual !== undefined && usual !== ''
    })
    expect(wrong).toEqual([])
  })

  test.each(names)('%s: its labels are those in its page', (name) => {
    const catalogue = JSON.parse(readText(`nodes/locales/en-US/${name}.json`)) as { label: Record<string, string> }
    const rows = tableAfter(pageOf(name), 'properties').map(
      ([setting, label]) => [codeOf(setting) ?? '', label] as const,
    )
    const wrong = rows.filter(([setting, label]) => label !== (catalogue.label[setting] ?? '–'))
    expect(wrong).toEqual([])
  })

  test.each(names)('%s is in the README', (name) => {
    expect(codeSpansOf(proseOf('README.md'))).toContain(name)
  })

  test.each([
    ['control', 'commands', 'control-commands', 'melsecControls'],
    ['control', 'commands: jw', 'control-commands', 'jwControls'],
    ['file', 'actions', 'melsec-jw-file', 'actions'],
  ])('what the %s node can do is in its page: %s', (name, list, file, constant) => {
    const tree = [...nodesOf(parseTypeScript(readText(`nodes/${file}.ts`)))]
    const table = tree.find((node) => node.type === 'VariableDeclarator' && textOf(node.id) === constant)
    const keys = [...nodesOf(table?.init)].find(({ type }) => type === 'ObjectExpression')?.properties
    const named = (keys as SyntaxNode[]).map(({ key }) => textOf(key))
    expect(namesIn(`docs/nodes/${name}.md`, list).sort()).toEqual(named.sort())
  })
})

describe('the pages of setting up PLCs', () => {
  const pages = filesBelow('docs/plc-setup', '.md')

  test('name every profile of the PLCs they are about', () => {
    const named = new Set(pages.flatMap((path) => codeSpansOf(proseOf(path))))
    const without = ['remote-head', 'nz2gf-etb', 'generic']
    expect(profileIds.filter((id) => !named.has(id))).toEqual(without)
  })

  test('override no limits: a port with limits of its own has a profile of its own', () => {
    expect(pages.filter((path) => /limits:/.test(readText(path)))).toEqual([])
  })
})
