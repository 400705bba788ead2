/** What a node says of a failure, in the language of the runtime. */
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { describe, expect, test } from '@jest/globals'
import { detailsOf, failureOf } from '../../nodes/failure'
import { Display } from '../../nodes/status'
import type { Texts } from '../../nodes/texts'
import { commands } from '../../src/entry/codec'
import {
  type CommandName,
  type EndCodeDetail,
  EndCodeError,
  explainEndCode,
  type Language,
  languages,
  UnfinishedError,
} from '../../src/index'
import { root } from '../support/root'

/** The shared catalogue of a language, as Node-RED fills it in. */
function textsIn(language: Language): Texts {
  const path = join(root, 'nodes/locales', language, 'melsec-jw-connection.json')
  const catalogue: unknown = JSON.parse(readFileSync(path, 'utf8'))
  return (key, values = {}) => {
    const text = key.split('.').reduce((at: unknown, name) => Object(at)[name], catalogue)
    return String(text).replace(/__(\w+?)__/g, (_all, name: string) => String(values[name]))
  }
}

const slmp = (code: number, language: Language = 'en-US') => explainEndCode(code, { family: 'slmp', language })

function refused(endCode: number, commandName: CommandName, more: Partial<EndCodeDetail> = {}): EndCodeError {
  const { title } = commands[commandName]
  return new EndCodeError(endCode, `${title} was refused.`, {
    family: 'slmp',
    about: 'item',
    carriedOut: false,
    command: title,
    commandName,
    ...more,
  })
}

test('a status shows an end code with the digits of its family', () => {
  const shown: unknown[] = []
  const node = { status: (status: unknown) => void shown.push(status) }
  const texts = textsIn('en-US')
  // Of a node the display needs its status only.
  const display = new Display(node as unknown as ConstructorParameters<typeof Display>[0], texts)
  display.failed(failureOf(refused(0xc056, 'readWords'), texts))
  display.failed(failureOf(refused(0x56, 'readWords', { family: '1E' }), texts))
  expect(shown).toEqual([
    expect.objectContaining({ text: texts('status.endCode', { code: 'C056' }), endCode: 0xc056 }),
    expect.objectContaining({ text: texts('status.endCode', { code: '56' }), endCode: 0x56 }),
  ])
})

describe('an end code', () => {
  test.each(languages.filter((language) => language !== 'en-US'))(
    'in %s: what may have been carried out is not called refused',
    (language) => {
      const texts = textsIn(language)
      const error = new EndCodeError(0x4042, 'Write (word units) ended with end code 4042.', {
        family: 'slmp',
        about: 'item',
        command: 'Write (word units)',
        commandName: 'writeWords',
        meaning: 'The module cannot be accessed.',
      })
      const { meaning = '', remedy = '' } = slmp(0x4042, language) ?? {}
      const values = { command: texts('command.writeWords'), code: '4042H', meaning, remedy }
      expect(detailsOf(error, texts)).toMatchObject({
        outcome: 'unknown',
        message: texts('error.leftOpen', values),
      })
      expect(texts('error.leftOpen', values)).not.toBe('undefined')
    },
  )

  test.each(languages.filter((language) => language !== 'en-US'))('in %s: message, meaning and remedy', (language) => {
    const { meaning = '', remedy = '' } = slmp(0xc056, language) ?? {}
    const details = detailsOf(refused(0xc056, 'readWords'), textsIn(language))
    expect(details).toMatchObject({ code: 'END_CODE', endCode: 0xc056, meaning, remedy })
    // The command by its name in the language; programs get the one of the manual.
    expect(details.message).toContain(textsIn(language)('command.readWords'))
    expect(details).toMatchObject({
      command: 'Read (word units)',
      commandName: 'readWords',
      family: 'slmp',
      about: 'item',
    })
    expect(details.message).toContain(`C056H`)
    expect(details.message).toContain(`${meaning} ${remedy}`)
    expect(details.message).not.toContain('__')
  })

  test("in English the message is the library's own", () => {
    expect(detailsOf(refused(0xc056, 'readWords'), textsIn('en-US')).message).toBe('Read (word units) was refused.')
  })

  test('of a command with a known cause tells it', () => {
    const details = detailsOf(refused(0xc059, 'executeMonitor'), textsIn('ja'))
    expect(details.meaning).toContain('モニタ登録がありません')
  })

  test('5BH of a 1E frame tells why', () => {
    const details = detailsOf(refused(0x5b, 'readWords', { family: '1E', abnormalCode: 0x18 }), textsIn('zh-CN'))
    expect(details).toMatchObject({
      endCode: 0x5b,
      abnormalCode: 0x18,
      meaning: expect.stringContaining('远程RUN/STOP'),
    })
    expect(details.remedy).toBe(explainEndCode(0x18, { family: '1E', language: 'zh-CN' })?.remedy)
    expect(details.message).toContain('5BH, 18H')
  })

  test('nobody knows passes through: no text is made up', () => {
    const details = detailsOf(refused(0x9999, 'readWords', { about: 'unknown' }), textsIn('ja'))
    expect(details).toEqual({
      code: 'END_CODE',
      message: 'Read (word units) was refused.',
      outcome: 'refused',
      endCode: 0x9999,
      family: 'slmp',
      about: 'unknown',
      command: 'Read (word units)',
      commandName: 'readWords',
    })
  })

  test('of a family whose numbers mean something else gets no text of this one', () => {
    // As a Sharp JW answers: 10H would be the PC No. error of a 1C frame.
    const details = detailsOf(refused(0x10, 'readWords', { family: 'jw' }), textsIn('zh-TW'))
    expect(details).toMatchObject({ family: 'jw', meaning: '寫入模式不符。' })
    expect(details.message).toContain('寫入模式不符。')
    const unknown = detailsOf(refused(0x05, 'readWords', { family: 'jw' }), textsIn('zh-TW'))
    expect(unknown).not.toHaveProperty('meaning')
    expect(unknown).toMatchObject({ family: 'jw', message: 'Read (word units) was refused.' })
  })

  test('names the command by its name, whatever its title', () => {
    const error = refused(0x56, 'readWords', { family: '1E', command: 'Batch read (word units)' })
    expect(detailsOf(error, textsIn('ja')).message).toContain(textsIn('ja')('command.readWords'))
    expect(detailsOf(error, textsIn('ja')).message).toContain('56H')
    // A 1E frame has commands that the SLMP set does not have.
    const other = refused(0x56, 'readWords', { family: '1E', commandName: 'loopback', command: 'Loopback test' })
    expect(detailsOf(other, textsIn('ja')).message).toContain('Loopback test')
  })
})

test.each(languages)('what was begun and not finished says in %s why, but not that nothing was done', (language) => {
  const cause = refused(0xc056, 'writeFile')
  const error = new UnfinishedError('4:\\A.CSV: 1920 of its 4000 bytes are overwritten.', cause)
  const { meaning, remedy } = slmp(0xc056, language) ?? {}
  expect(detailsOf(error, textsIn(language))).toMatchObject({
    code: 'UNFINISHED',
    outcome: 'unknown',
    message: error.message,
    endCode: 0xc056,
    meaning,
    remedy,
  })
  expect(textsIn(language)('status.unfinished')).not.toBe('undefined')
})
