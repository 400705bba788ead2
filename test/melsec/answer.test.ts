/** What an answer must not be: about another command, or longer than what was asked for. */
import { describe, expect, test } from '@jest/globals'
import type { DataCode } from '../../src/codec/codec'
import { commands } from '../../src/melsec/commands/commands'
import { ownStation } from '../../src/melsec/frame/route'
import { slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'

function asked(code: DataCode) {
  const head = { ...ownStation, timer: 0 }
  const protocol = new MelsecProtocol({ framing: slmpFraming('3E', code), head, profile: resolveProfile('q'), code })
  const { decode } = protocol.exchange(commands.readWords, { head: { device: 'D', number: 100 }, points: 2 })
  const information = (command: number, subcommand: number) =>
    protocol.writeErrorInformation({ ...ownStation, command, subcommand })
  return {
    information,
    answer: (endCode: number, body: Buffer) => decode({ head, serial: undefined, endCode, body }),
  }
}

describe.each(['binary', 'ascii'] as const)('in %s code', (code) => {
  const { answer, information } = asked(code)
  const [words, more, less] = code === 'binary' ? ['01000200', '00', '010002'] : ['00010002', '0', '0001000']
  const data = (text = '') => Buffer.from(text, code === 'binary' ? 'hex' : 'latin1')

  test('an end code with the error information of this command is a refusal', () => {
    expect(() => answer(0xc05c, information(0x0401, 0))).toThrow(expect.objectContaining({ code: 'END_CODE' }))
  })

  test.each([
    ['another command', 0x1401, 0],
    ['another subcommand', 0x0401, 1],
  ])('an end code with the error information of %s is none', (_what, command, subcommand) => {
    const mismatch = expect.objectContaining({ code: 'ECHO_MISMATCH' })
    expect(() => answer(0xc05c, information(command, subcommand))).toThrow(mismatch)
  })

  test('data that are longer or shorter than what was asked for are none', () => {
    expect(answer(0, data(words))).toEqual({ values: [1, 2] })
    expect(() => answer(0, data(`${words}${more}`))).toThrow(expect.objectContaining({ code: 'TRAILING' }))
    expect(() => answer(0, data(less))).toThrow(expect.objectContaining({ code: 'TRUNCATED' }))
  })
})
