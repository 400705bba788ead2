import { hex } from '../basics/hex'
import { EndCodeError, type Identity, type MelsecClient, type PlcError, RequestError } from '../index'
import { type MakeCommand, newCommand, perform } from './command'
import {
  type AnyConnectionOptions,
  addAnyConnectionOptions,
  type ConnectionOptions,
  peerText,
  withClient,
} from './connection-options'
import { exitCodes } from './exit-code'
import { byFamily } from './family'
import { jwPlc } from './jw/connection'
import { identifyJw } from './jw/identify'
import { errorText, json, table } from './output'
import type { Terminal } from './terminal'

const examples = [
  'identify --plc 192.168.3.39:5010',
  'identify --plc 192.168.3.250:5010 --profile iq-f --json',
  'identify --plc 192.168.3.60:4000 --family jw',
]

/** `melsec-jw identify` */
export const identifyCommand: MakeCommand = (run) => {
  const command = addAnyConnectionOptions(newCommand('identify', 'connect, and ask the PLC who it is', examples))
  return command.action((options: AnyConnectionOptions) =>
    perform(run, options, () =>
      byFamily(command, options, {
        melsec: () => identify(run.terminal, options),
        jw: () => identifyJw(run.terminal, options, jwPlc(run.terminal, options)),
      }),
    ),
  )
}

function identify(terminal: Terminal, options: ConnectionOptions): Promise<number> {
  return withClient(terminal, options, {}, async (client) => {
    try {
      show(terminal, options, client, await client.identify())
      return exitCodes.ok.code
    } catch (error) {
      // Built-in ports of Q and L do not have the command. A refusal is an answer: the PLC is there.
      if (error instanceof EndCodeError) {
        showUnnamed(terminal, options, client, error)
        return exitCodes.refused.code
      }
      if (!(error instanceof RequestError) || error.code !== 'UNSUPPORTED') throw error
      // The profile knows that, so it was not asked. Connecting asks for something else, and that is worth knowing.
      await client.connect()
      showUnnamed(terminal, options, client, error)
      return exitCodes.usage.code
    }
  })
}

function show(terminal: Terminal, options: ConnectionOptions, client: MelsecClient, identity: Identity): void {
  const roundTrip = client.statistics.roundTrip?.last
  if (options.json === true) {
    terminal.out(json({ plc: peerText(options), ...identity, roundTrip }))
    return
  }
  const { model, modelCode, models, series, profile, warning } = identity
  const known = models.length === 0 ? 'not in the manuals' : models.join(' or ')
  terminal.out(
    table([
      ['PLC', linkText(options, client)],
      ['Model', model.trim() === '' ? 'not told' : model],
      ['Model code', `${hex(modelCode, 4)}H (${known})`],
      ...(series === undefined ? [] : [['Series', series]]),
      ...(profile === undefined ? [] : [['Profile', profileText(profile, client)]]),
      ['Round trip', roundTripText(roundTrip)],
    ]),
  )
  if (warning !== undefined) terminal.error(`Warning: ${warning.message} (--w-radix 10)`)
}

function showUnnamed(terminal: Terminal, options: ConnectionOptions, client: MelsecClient, error: PlcError): void {
  const roundTrip = client.statistics.roundTrip?.last
  if (options.json === true) terminal.out(json({ plc: peerText(options), error: error.toJSON(), roundTrip }))
  else
    terminal.out(
      table([
        ['PLC', linkText(options, client)],
        ['Model', 'not told'],
        ['Round trip', roundTripText(roundTrip)],
      ]),
    )
  terminal.error(`The PLC answers, so the connection works. ${errorText(error)}`)
}

function linkText(options: ConnectionOptions, client: MelsecClient): string {
  return `${peerText(options)}, ${options.frame ?? client.profile.frame} frame, ${client.code} code`
}

function profileText(fitting: string, { profile }: MelsecClient): string {
  return fitting === profile.id ? fitting : `${fitting} (this was asked as ${profile.id}: use --profile ${fitting})`
}

function roundTripText(ms: number | undefined): string {
  return ms === undefined ? 'not measured' : `${ms.toFixed(1)} ms`
}
