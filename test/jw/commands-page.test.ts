/** The table of docs/jw-commands.md is that of the declarations, and its examples are right. */
import { describe, expect, test } from '@jest/globals'
import type { JwDeclaration } from '../../src/jw/commands/command'
import { jwCommands } from '../../src/jw/commands/commands'
import { explainJwFrame } from '../../src/jw/explain-frame'
import type { NamedCommand } from '../../src/link/link'
import { tableAfter } from '../docs/markdown'

const commands: readonly (NamedCommand & JwDeclaration)[] = Object.values(jwCommands)
const rows = tableAfter('docs/jw-commands.md', 'jw commands')

test('has every command, with what it does and what confirms it', () => {
  const expected = commands.map(({ code, name, title, effect, confidence }) => {
    return [`${code.toString(16).toUpperCase().padStart(2, '0')}H`, `\`${name}\``, title, effect, confidence]
  })
  expect(rows.map((row) => row.slice(0, 5))).toEqual(expected)
})

describe('example', () => {
  test.each(rows.map((row) => [row[1] ?? '', row[5] ?? '', row[6] ?? '']))('of %s', (name, request, response) => {
    const asked = bytesOf(request)
    const explained = explainJwFrame(asked)
    expect(explained.fault).toBeUndefined()
    expect(`\`${explained.command}\``).toBe(name)
    const answered = explainJwFrame(bytesOf(response), { request: asked })
    expect(answered.fault).toBeUndefined()
    expect([answered.rest, answered.endCode]).toEqual([0, 0])
  })
})

function bytesOf(cell: string): Buffer {
  return Buffer.from(cell.replace(/[` ]/g, ''), 'hex')
}
