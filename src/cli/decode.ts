import type { Command } from 'commander'
import { type ExplainJwOptions, explainFrame, explainJwFrame, formatExplanation } from '../entry/codec'
import { type DataCode, frameNames, type JwHeader, type ProfileId, RequestError } from '../index'
import { bytesOfText, pastedBytes } from './bytes'
import { type MakeCommand, newCommand, perform } from './command'
import { addDigitOptions, profileOption, wRadixOption } from './connection-options'
import { exitCodes } from './exit-code'
import { byFamily, type FamilyOptions, familyOption, onlyFor } from './family'
import { headerOption, markerOption } from './jw/connection'
import { choice, jsonOption } from './option'
import { json } from './output'
import type { Terminal } from './terminal'

const examples = [
  'decode 500000FFFF03000C00100001040000640000A80100',
  'decode D00000FFFF0300040000002A00 --request 500000FFFF03000C00100001040000640000A80100',
  "decode --text '500000FF03FF000018001004010000D*0001000001'",
  'decode --frame 1E 01FF0A00640000002044 0300',
  "decode '<ENQ>00FFBR0M00100A<CR><LF>'",
  'decode --family jw 4700240000080400',
  "decode '<Buffer 50 00 00 ff ff 03 00 0c 00 10 00 01 04 00 00 64 00 00 a8 01 00>'",
  'decode -            (reads the digits, or a hex dump, from the standard input)',
]

type ExplainOptions = NonNullable<Parameters<typeof explainFrame>[1]>
type Explanation = ReturnType<typeof explainFrame>

interface DecodeOptions extends FamilyOptions, Pick<ExplainOptions, 'asciiXy' | 'asciiZr' | 'wRadix'> {
  readonly frame?: (typeof FRAMES)[number]
  readonly format?: (typeof FORMATS)[number]
  readonly sumCheck?: boolean
  readonly request?: string
  readonly registration?: string
  readonly text?: boolean
  readonly code?: DataCode
  readonly header?: JwHeader
  readonly marker?: 'once' | 'each'
  readonly profile: ProfileId
  readonly json?: boolean
}

const FRAMES = [...frameNames, 'JW'] as const satisfies readonly (ExplainOptions['frame'] | 'JW')[]
const FORMATS = ['1', '4', '5'] as const
const formats = { '1': 1, '4': 4, '5': 5 } as const satisfies Record<(typeof FORMATS)[number], number>

/** `melsec-jw decode` */
export const decodeCommand: MakeCommand = (run) => {
  const command = newCommand('decode', 'explain a captured frame, field by field', examples)
    .description(
      'Explain a captured frame field by field: a request or a response, in 3E, 4E, station extension, 1C, 3C or 4C (told by the frame itself), ' +
        '1E or Sharp JW (to be said). What the values of a response mean is in its request: give that too.',
    )
    .argument(
      '<hex...>',
      "bytes of one or several frames: hexadecimal digits, a hex dump, <Buffer ...> of Node.js, b'...' of Python, characters with <ENQ>, <CR> and so on; - for the standard input",
    )
    .option('--request <hex>', 'the request that the frame answers')
    .addOption(familyOption())
    .addOption(choice('--frame <name>', 'frame; ext is station extension, JW is --family jw', FRAMES))
  onlyFor('melsec', 'The messages of a Sharp JW have one form, in binary: leave it out.', command, addMelsecOptions)
  onlyFor('jw', 'Say --family jw with it, or leave it out.', command, () =>
    command.addOption(headerOption()).addOption(markerOption()),
  )
  command.addOption(jsonOption())
  return command.action((texts: readonly string[], options: DecodeOptions) =>
    perform(run, options, () =>
      byFamily(command, familyOf(options), {
        melsec: () => decode(run.terminal, texts, options, explainFrame),
        jw: () => decode(run.terminal, texts, options, explainJwFrame),
      }),
    ),
  )
}

function addMelsecOptions(command: Command): void {
  command
    .option('--registration <hex>', 'the Entry Monitor Device before it, when the frame answers an Execute Monitor')
    .option('--text', 'the arguments are the characters of frames in ASCII code, not hexadecimal digits')
    .addOption(choice('--format <format>', 'of 1C, 3C and 4C; told by the frame', FORMATS))
    .option('--sum-check', '1C, 3C and 4C: with sum check code; told by the frame where it can be')
    .option('--no-sum-check', '1C, 3C and 4C: without sum check code')
    .addOption(choice('--code <code>', 'data code', ['binary', 'ascii']))
    .addOption(profileOption().default('generic'))
  addDigitOptions(command).addOption(wRadixOption())
}

/** `--frame JW` says the family, too. @throws RequestError BAD_OPTION when both are given and do not agree */
function familyOf({ family, frame }: DecodeOptions): FamilyOptions {
  if (frame === 'JW') return { family: 'jw' }
  if (family === 'jw' && frame !== undefined) {
    throw new RequestError('BAD_OPTION', `${frame} is no frame of a Sharp JW: leave --frame out.`, 'frame')
  }
  return { family }
}

async function decode(
  terminal: Terminal,
  texts: readonly string[],
  options: DecodeOptions,
  explainOne: (bytes: Buffer, settings: ReturnType<typeof explainOptions>) => Explanation,
): Promise<number> {
  const given = texts.length === 1 && texts[0] === '-' ? await terminal.input() : texts.join(' ')
  // No frame in ASCII code begins with it: there it stands around a control code.
  const pieces = (text: string, what: string) =>
    options.text === true && !/^\s*</.test(text) ? [bytesOfText(text)] : pastedBytes(text, what)
  const settings = explainOptions(options, (text, what) => Buffer.concat(pieces(text, what)))
  const frames = explainPieces(pieces(given, 'the frame'), (rest) => explainOne(rest, settings))
  const wrong = frames.some(({ fault }) => fault !== undefined)
  if (options.json === true) terminal.out(json({ frames }))
  else terminal.out(frames.map(formatExplanation).join('\n\n'))
  if (wrong && options.text !== true && isAsciiFrame(given)) {
    terminal.error('As the characters of a frame in ASCII code this is right: use --text.')
  }
  return wrong ? exitCodes.protocol.code : exitCodes.ok.code
}

function explainOptions(
  options: DecodeOptions,
  bytes: (text: string, what: string) => Buffer,
): ExplainOptions & Omit<ExplainJwOptions, 'direction'> {
  const { frame, format, sumCheck, code, profile, request, registration, asciiXy, asciiZr, wRadix } = options
  const { header, marker } = options
  return {
    profile,
    ...(frame === undefined || frame === 'JW' ? {} : { frame }),
    ...(format === undefined ? {} : { format: formats[format] }),
    ...(sumCheck === undefined ? {} : { sumCheck }),
    ...(code === undefined ? {} : { code }),
    ...(header === undefined ? {} : { header }),
    ...(marker === undefined ? {} : { marker }),
    ...(asciiXy === undefined ? {} : { asciiXy }),
    ...(asciiZr === undefined ? {} : { asciiZr }),
    ...(wRadix === undefined ? {} : { wRadix }),
    ...(request === undefined ? {} : { request: bytes(request, 'the request') }),
    ...(registration === undefined ? {} : { registration: bytes(registration, 'the registration') }),
  }
}

/**
 * What was pasted in pieces, such as several Buffers, may be pieces of one stream, cut anywhere. Where that makes no right
 * frames each piece is explained for itself, so that one that is broken does not hide the next.
 */
function explainPieces(pieces: readonly Buffer[], explain: (rest: Buffer) => Explanation): readonly Explanation[] {
  const joined = explainAll(Buffer.concat(pieces), explain)
  if (pieces.length === 1 || joined.every(({ fault }) => fault === undefined)) return joined
  return pieces.flatMap((piece) => explainAll(piece, explain))
}

/** A capture of a TCP stream may hold several frames, one behind the other. */
function explainAll(bytes: Buffer, explain: (rest: Buffer) => Explanation): readonly Explanation[] {
  const frames: Explanation[] = []
  let rest = bytes
  while (rest.length > 0) {
    const explanation = explain(rest)
    const last = explanation.rest === 0 || explanation.rest === rest.length || explanation.fault !== undefined
    frames.push(last ? explanation : { ...explanation, rest: 0 })
    if (last) return frames
    rest = rest.subarray(rest.length - explanation.rest)
  }
  return frames
}

/** Digits that are no frame as bytes, but one as the characters of ASCII code. */
function isAsciiFrame(text: string): boolean {
  const explanation = explainFrame(bytesOfText(text.replace(/\s/g, '')), { code: 'ascii' })
  return explanation.fault === undefined
}
