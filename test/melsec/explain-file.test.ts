// Frames of file commands in words.

import { describe, expect, test } from '@jest/globals'
import { MASK } from '../../src/codec/annotate'
import { maskSecrets } from '../../src/codec/explanation'
import type { Command } from '../../src/melsec/commands/command'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import { explainFrame } from '../../src/melsec/explain/frame'
import { type SlmpHead, slmpFraming } from '../../src/melsec/frame/slmp-frame'
import { profiles } from '../../src/melsec/profiles/profiles'
import { MelsecProtocol } from '../../src/melsec/protocol'
import { bytesOf, type RequestDataVector, vectorsOfKind } from '../vectors/vectors'

const head: SlmpHead = { network: 0, station: 0xff, moduleIo: 0x3ff, multidrop: 0, timer: 16 }

function familyOf({ subcommand }: { readonly subcommand?: number }) {
  return subcommand === 0x40 ? profiles['iq-r'] : profiles.q
}

/** The frame of a vector and what its message holds. */
function framed(vector: RequestDataVector): Buffer {
  return slmpFraming('3E', vector.code).request.write(head, 0, bytesOf(vector))
}

const requests = vectorsOfKind('files', 'requestData')

test.each(requests)('$id is explained to its last byte, without its password', (vector) => {
  const frame = framed(vector)
  const explained = explainFrame(frame, { code: vector.code, profile: familyOf(vector) })
  expect(explained.fault).toBeUndefined()
  expect(explained.command).toBe(vector.command)
  const data = explained.rows.filter(({ offset }) => offset >= (vector.code === 'ascii' ? 30 : 15))
  expect(data.reduce((sum, { length }) => sum + length, 0)).toBe(
    bytesOf(vector).length - (vector.code === 'ascii' ? 8 : 4),
  )
  const { password, sourcePassword, name, date } = vector.message
  const said = JSON.stringify(explained) + maskSecrets(frame, explained).toString('latin1')
  for (const secret of [password, sourcePassword]) {
    if (typeof secret !== 'string' || secret === '') continue
    expect(said).toContain(MASK)
    expect(said).not.toContain(secret)
    expect(said).not.toContain(Buffer.from(secret).toString('hex').slice(0, 8))
  }
  if (typeof name === 'string') expect(explained.title).toContain(`:${name}`)
  if (date !== undefined) expect(said).toContain('2010-04-01 20:50:58')
})

describe('an answer', () => {
  const protocol = new MelsecProtocol<SlmpHead>({
    framing: slmpFraming('3E', 'binary'),
    head,
    profile: profiles['iq-r'],
    code: 'binary',
  })

  function answered(name: CommandName, message: object, response: Readonly<Record<string, unknown>>) {
    const command: Command = commands[name]
    const exchange = protocol.exchange(command, message)
    const request = protocol.framing.request.write(head, 0, exchange.body)
    const asked = { command, name, form: 'short', subcommand: 0x40, message: exchange.message } as const
    const body = protocol.writeResponse(asked, response)
    const frame = protocol.framing.response.write(head, 0, 0, body)
    return explainFrame(frame, { code: 'binary', profile: profiles['iq-r'], request })
  }

  test('names files, their attributes and dates', () => {
    const modified = { year: 2015, month: 12, day: 17, hour: 14, minute: 15, second: 14 }
    const files = [
      { name: 'LINE.CSV', attribute: 0x01, modified, size: 1024 },
      { name: 'LOG', attribute: 0x30, modified, size: 0 },
    ]
    const { rows, fault } = answered('readDirectory', { drive: 4, start: 1, count: 9 }, { lastFileNumber: 5, files })
    expect(fault).toBeUndefined()
    const words = Object.fromEntries(rows.map(({ name, text }) => [name, text]))
    expect(words).toMatchObject({
      fileCount: '2',
      'files.0.name': '"LINE.CSV"',
      'files.0.attribute': '01H (read-only file)',
      'files.0.modified': '2015-12-17 14:15:14',
      'files.1.attribute': '30H (directory)',
    })
  })

  test('gives the file pointer', () => {
    const { rows } = answered('openFile', { drive: 4, name: 'A.CSV', mode: 0, password: 'hidden' }, { pointer: 3 })
    expect(rows.find(({ name }) => name === 'pointer')?.text).toContain('3 (file pointer number')
  })
})
