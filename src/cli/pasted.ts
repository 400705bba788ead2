// Bytes in the forms that programs and analysers print: Buffers of Node.js, literals of Python, hex dumps, control codes in words.
import { controlCodes } from '../entry/codec'
import { RequestError } from '../index'

/**
 * The pieces of a text in one of these forms, one for each Buffer, literal or packet; `undefined` when it is in none.
 * @throws RequestError BAD_VALUE for one that is cut or broken
 * @example piecesOf('<Buffer 50 00> <Buffer d0 00>', 'the frame') // two Buffers
 */
export function piecesOf(text: string, what: string): Buffer[] | undefined {
  return nodeBuffers(text, what) ?? pythonLiterals(text, what) ?? hexDump(text, what) ?? controlWords(text, what)
}

function bad(what: string, reason: string): never {
  throw new RequestError('BAD_VALUE', `${what}: ${reason}`, what)
}

const NODE_BUFFER = /<Buffer\b([^>]*)>/g

function nodeBuffers(text: string, what: string): Buffer[] | undefined {
  const found = [...text.matchAll(NODE_BUFFER)]
  if (found.length === 0) return undefined
  return found.map(([, inside = '']) => {
    const digits = inside.replace(/\s/g, '')
    if (/more bytes?$/.test(inside.trim())) {
      bad(what, 'Node.js has shortened this Buffer ("... more bytes"). Print it with .toString(\'hex\').')
    }
    if (!/^([0-9a-f]{2})+$/i.test(digits)) bad(what, `${JSON.stringify(`<Buffer${inside}>`)} holds no bytes.`)
    return Buffer.from(digits, 'hex')
  })
}

/** `b'...'` or `b"..."`, with escapes. */
const PYTHON_BYTES = /\bb(?:'((?:[^'\\]|\\.)*)'|"((?:[^"\\]|\\.)*)")/gs
const ESCAPE = /\\(x[0-9a-f]{2}|[0-7]{1,3}|[\s\S])/gi
const NAMED: Readonly<Record<string, string>> = { n: '\n', r: '\r', t: '\t', a: '\x07', b: '\b', f: '\f', v: '\v' }

function pythonLiterals(text: string, what: string): Buffer[] | undefined {
  const found = [...text.matchAll(PYTHON_BYTES)]
  if (found.length === 0) return undefined
  return found.map(([, single, double]) => {
    const characters = (single ?? double ?? '').replace(ESCAPE, (whole, code: string) => unescaped(whole, code, what))
    const wide = /[^\0-\xff]/.exec(characters)
    if (wide !== null) bad(what, `${JSON.stringify(wide[0])} is no byte.`)
    if (characters === '') bad(what, 'there are no bytes.')
    return Buffer.from(characters, 'latin1')
  })
}

function unescaped(whole: string, code: string, what: string): string {
  if (/^x./i.test(code)) return String.fromCharCode(Number.parseInt(code.slice(1), 16))
  if (/^[0-7]/.test(code)) return String.fromCharCode(Number.parseInt(code, 8))
  const known = NAMED[code] ?? (/['"\\]/.test(code) ? code : undefined)
  return known ?? bad(what, `${whole} is no escape of a byte.`)
}

/** A line of a hex dump: where it begins, and what stands behind. */
interface Line {
  readonly offset: number
  readonly rest: string
}

/** Offset, then at least one byte of two digits; a colon makes any grouping sure. */
const DUMP_LINE = /^\s*(?:0x)?([0-9a-f]{4,8})(?::\s*|\s+(?=[0-9a-f]{2}(?:\s|$))|\s*$)(.*)$/i
/** Bytes of a full line. */
const FULL = 16

function hexDump(text: string, what: string): Buffer[] | undefined {
  const lines = text
    .split('\n')
    .filter((line) => line.trim() !== '')
    .map(dumpLine)
  const [first] = lines
  if (first?.offset !== 0 || first.rest === '') return undefined
  const pieces: number[][] = []
  for (const [i, line] of lines.entries()) {
    if (line === undefined) return undefined
    if (line.offset === 0) pieces.push([])
    const piece = pieces.at(-1) ?? []
    if (line.offset !== piece.length) {
      bad(
        what,
        `line ${i + 1} of the hex dump begins at ${line.offset.toString(16)}, the one before ends at ${piece.length.toString(16)}.`,
      )
    }
    const next = lines[i + 1]?.offset ?? 0
    piece.push(...bytesOfLine(line.rest, next > line.offset ? next - line.offset : lines[1]?.offset || undefined))
  }
  return pieces.map((piece) => Buffer.from(piece))
}

function dumpLine(line: string): Line | undefined {
  const [, offset, rest = ''] = DUMP_LINE.exec(line) ?? []
  return offset === undefined ? undefined : { offset: Number.parseInt(offset, 16), rest }
}

/**
 * What stands behind the bytes is what they look like as characters: three blanks or a bar are in front of it, or two
 * blanks behind a full line. `most`: bytes of the line, where another line tells; a shell that joins lines leaves the
 * offsets of the others among the bytes.
 */
function bytesOfLine(rest: string, most = Number.POSITIVE_INFINITY): number[] {
  const [digits = ''] = rest.split(/\s{3,}|\|/)
  const bytes: number[] = []
  for (const [, gap = '', group = ''] of digits.matchAll(/(\s*)(\S+)/g)) {
    if (bytes.length >= most || (bytes.length === FULL && gap.length > 1)) break
    if (/^[0-9a-f]{4,8}:?$/i.test(group) && bytes.length >= FULL && Number.parseInt(group, 16) === bytes.length)
      continue
    if (!/^([0-9a-f]{2})+$/i.test(group)) break
    bytes.push(...Buffer.from(group, 'hex'))
  }
  return bytes
}

/** `<ENQ>` or `<05>` among characters, as terminal programs and logs of serial lines write control codes. */
const CONTROL_WORD = /<([^<>]*)>/g
const codes = new Map<string, number>([...Object.entries(controlCodes), ['FF', controlCodes.CL]])

/** One piece: what stands on several lines is one stream. Blanks within a line are characters. */
function controlWords(text: string, what: string): Buffer[] | undefined {
  if (text.search(CONTROL_WORD) < 0) return undefined
  const lines = text.split('\n').map((line) => line.trim())
  const characters = lines.join('').replace(CONTROL_WORD, (whole, word: string) => {
    const code = codes.get(word.toUpperCase()) ?? (/^[0-9a-f]{2}$/i.test(word) ? Number.parseInt(word, 16) : undefined)
    if (code === undefined) bad(what, `${whole} is no control code: ${[...codes.keys()].join(', ')}, or two digits.`)
    return String.fromCharCode(code)
  })
  return [Buffer.from(characters, 'latin1')]
}
