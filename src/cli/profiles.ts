import { type ProfileInfo, profileIds, profiles, resolveProfile } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import { exitCodes } from './exit-code'
import { type FamilyOptions, familyOption, onlyOf } from './family'
import { choiceArgument, jsonOption } from './option'
import { json, table } from './output'
import type { Terminal } from './terminal'

const NO_PROFILES = { what: 'profiles', instead: 'Say the family of its CPU with --model: jw300 or jw30h.' }

const examples = ['profiles', 'profiles iq-f']

/** `melsec-jw profiles` */
export const profilesCommand: MakeCommand = (run) =>
  newCommand('profiles', 'the families of PLCs that are known, and what they are like', examples)
    .addArgument(choiceArgument('[id]', 'one of them, with all that is known', profileIds))
    .addOption(familyOption())
    .addOption(jsonOption())
    .action((id: (typeof profileIds)[number] | undefined, options: FamilyOptions & { readonly json?: boolean }) =>
      perform(run, options, () =>
        onlyOf('melsec', NO_PROFILES, options, async () => {
          show(run.terminal, id === undefined ? undefined : resolveProfile(id), options.json === true)
          return exitCodes.ok.code
        }),
      ),
    )

function show(terminal: Terminal, profile: ProfileInfo | undefined, asJson: boolean): void {
  if (asJson) terminal.out(json(profile ?? { profiles: Object.values(profiles) }))
  else terminal.out(profile === undefined ? overview() : details(profile))
}

const XY = { 8: 'octal', 16: 'hexadecimal' } as const

function overview(): string {
  const rows = Object.values(profiles).map(({ id, title, frames, xyRadix, series }) => [
    id,
    title,
    frames.join(', '),
    XY[xyRadix],
    series,
  ])
  return table([['PROFILE', 'FAMILY', 'FRAMES', 'X AND Y', 'FOR'], ...rows])
}

function details(profile: ProfileInfo): string {
  const {
    id,
    title,
    series,
    frame,
    frames,
    codes,
    code,
    transports,
    xyRadix,
    absentDevices,
    inFlight,
    connections,
    reach,
    lastIndex,
    monitoringTimer,
    remote,
  } = profile
  const head = table([
    ['Profile', id],
    ['Family', title],
    ['For', series],
    ['Frames', `${frames.join(', ')} (usually ${frame})`],
    ['Codes', `${codes.join(', ')} (usually ${code})`],
    ['Transports', transports.join(', ')],
    ['X and Y', XY[xyRadix]],
    ['Without', absentDevices.length === 0 ? 'no device is missing' : absentDevices.join(' ')],
    ['In flight', inFlightText(profile)],
    ...inFlight.ports.map(({ port, buffer }) => ['', `1 + ${buffer} / connections over UDP: ${port}`]),
    ['Connections', `at most ${connections.most}`],
    ['Reaches', reach.stations === 'connected' ? 'the connected station only' : 'other stations, where its port does'],
    [
      'Indexed by',
      lastIndex.Z < 0 ? 'nothing' : `Z0 to Z${lastIndex.Z}${lastIndex.LZ < 0 ? '' : `, LZ0 to LZ${lastIndex.LZ}`}`,
    ],
    [
      'CPU state',
      remote.status === undefined ? 'cannot be read back' : `${remote.status.device}${remote.status.number}`,
    ],
    ['Monitoring timer', monitoringTimer.zeroOnly ? '0 only' : `usually ${monitoringTimer.default} ms`],
  ])
  const lacks = byReason(profile.lacks.map(({ command, reason, instead }) => [command, `${reason} ${instead}`]))
  const doubtful = byReason(profile.doubtful.map(({ command, reason }) => [command, reason]))
  const notes = profile.notes.map((note) => `  - ${note}`)
  return [
    head,
    ...titled('Commands it lacks:', lacks),
    ...titled('Not on every port:', doubtful),
    ...titled('To know:', notes),
  ].join('\n')
}

/** More than one at once takes a serial number, which the 4E frame alone has. */
function inFlightText({ inFlight, frames }: ProfileInfo): string {
  const tcp = `${inFlight.tcp} over TCP`
  return frames.includes('4E') ? `${tcp}, ${1 + inFlight.udpBuffer} over UDP with the 4E frame` : `${tcp} and UDP`
}

/** Commands with the same reason share a line: a family without files lacks eleven of them. */
function byReason(rows: readonly (readonly [command: string, reason: string])[]): readonly string[] {
  const commandsOf = new Map<string, string[]>()
  for (const [command, reason] of rows) commandsOf.set(reason, [...(commandsOf.get(reason) ?? []), command])
  return [...commandsOf].map(([reason, commands]) => `  - ${commands.join(', ')}: ${reason}`)
}

function titled(title: string, lines: readonly string[]): readonly string[] {
  return lines.length === 0 ? [] : ['', title, ...lines]
}
