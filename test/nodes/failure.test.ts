/** What a node says of a failure, in the language of the runtime. */
import { readFileSync } from 'node:fs'
import { join } from 'node:path'
import { describe, expect, test } from '@jest/globals'
import { detailsOf } from '../../nodes/failure'
import type { Texts } from '../../nodes/texts'
import { commands } from '../../src/entry/codec'
import { EndCodeError, explainEndCode, type Language, languages, UnfinishedError } from '../../src/index'
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

function refused(endCode: number, command: string, abnormalCode?: number): EndCodeError {
  const text = explainEndCode(endCode)
  return new EndCodeError(endCode, `${command} was refused.`, {
    command,
    ...(abnormalCode === undefined ? {} : { abnormalCode }),
    ...(text === undefined ? {} : { meaning: text.meaning, remedy: text.remedy }),
  })
}

describe('an end code', () => {
  test.each(languages.filter((language) => language !== 'en-US'))('in %s: message, meaning and remedy', (language) => {
    const { meaning = '', remedy = '' } = explainEndCode(0xc056, { language }) ?? {}
    const details = detailsOf(refused(0xc056, 'Read (word units)'), textsIn(language))
    expect(details).toMatchObject({ code: 'END_CODE', endCode: 0xc056, meaning, remedy })
    // The command by its name in the language; programs get the one of the manual.
    expect(details.message).toContain(textsIn(language)('command.readWords'))
    expect(details).toMatchObject({ command: 'Read (word units)' })
    expect(details.message).toContain(`C056H`)
    expect(details.message).toContain(`${meaning} ${remedy}`)
    expect(details.message).not.toContain('__')
  })

  test("in English the message is the library's own", () => {
    expect(detailsOf(refused(0xc056, 'Read (word units)'), textsIn('en-US')).message).toBe(
      'Read (word units) was refused.',
    )
  })

  test('of a command with a known cause tells it', () => {
    const details = detailsOf(refused(0xc059, commands.executeMonitor.title), textsIn('ja'))
    expect(details.meaning).toContain('モニタ登録がありません')
  })

  test('5BH of a 1E frame tells why', () => {
    const details = detailsOf(refused(0x5b, 'Read', 0x18), textsIn('zh-CN'))
    expect(details).toMatchObject({
      endCode: 0x5b,
      abnormalCode: 0x18,
      meaning: expect.stringContaining('远程RUN/STOP'),
    })
    expect(details.remedy).toBe(explainEndCode(0x18, { language: 'zh-CN' })?.remedy)
    expect(details.message).toContain('5BH, 18H')
  })

  test('nobody knows passes through: no text is made up', () => {
    const details = detailsOf(refused(0x9999, 'Read'), textsIn('ja'))
    expect(details).toEqual({
      code: 'END_CODE',
      message: 'Read was refused.',
      outcome: 'refused',
      endCode: 0x9999,
      command: 'Read',
    })
  })

  test('of a family whose numbers mean something else gets no text of this one', () => {
    // As a Sharp JW answers: 10H would be the PC No. error of a 1C frame.
    const details = detailsOf(new EndCodeError(0x10, 'refused', { command: 'Read' }), textsIn('zh-TW'))
    expect(details).not.toHaveProperty('meaning')
    expect(details.message).toBe('refused')
  })
})

test.each(languages)('what was begun and not finished says in %s why, but not that nothing was done', (language) => {
  const cause = refused(0xc056, 'Write File')
  const error = new UnfinishedError('4:\\A.CSV: 1920 of its 4000 bytes are overwritten.', cause)
  const { meaning, remedy } = explainEndCode(0xc056, { language }) ?? {}
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
