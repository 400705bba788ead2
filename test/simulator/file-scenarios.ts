/** What every file command must do on every family that has it; and that the others refuse it. */
import { expect } from '@jest/globals'
import { type CommandName, commands } from '../../src/melsec/commands/commands'
import type { fileCommandNames } from '../../src/melsec/profiles/files'
import type { Asker, Joined } from './support'

type FileCommand = (typeof fileCommandNames)[number]

const name = 'A.CSV'
const at = { drive: 4, name }
const date = { year: 2026, month: 5, day: 4, hour: 3, minute: 2, second: 0 }

/** A request of each, for those who only want to see it refused. */
export function fileRefusals(asker: Asker): Readonly<Record<FileCommand, () => number | undefined>> {
  return {
    readDirectory: () => asker.endCode(commands.readDirectory, { drive: 4, start: 1, count: 1 }),
    searchFile: () => asker.endCode(commands.searchFile, at),
    newFile: () => asker.endCode(commands.newFile, { ...at, size: 2 }),
    deleteFile: () => asker.endCode(commands.deleteFile, at),
    copyFile: () =>
      asker.endCode(commands.copyFile, {
        destinationDrive: 4,
        destinationName: 'B.CSV',
        sourceDrive: 4,
        sourceName: name,
      }),
    changeFileState: () => asker.endCode(commands.changeFileState, { ...at, attribute: 1 }),
    changeFileDate: () => asker.endCode(commands.changeFileDate, { ...at, date }),
    openFile: () => asker.endCode(commands.openFile, { ...at, mode: 0 }),
    readFile: () => asker.endCode(commands.readFile, { pointer: 0, offset: 0, byteCount: 2 }),
    writeFile: () => asker.endCode(commands.writeFile, { pointer: 0, offset: 0, data: Buffer.of(1, 2) }),
    closeFile: () => asker.endCode(commands.closeFile, { pointer: 0 }),
  }
}

function refused(command: FileCommand): (joined: Joined) => void {
  return ({ asker }) => expect(fileRefusals(asker)[command]()).toBe(0x4021)
}

export const fileScenarios = {
  readDirectory: refused('readDirectory'),
  searchFile: refused('searchFile'),
  newFile: refused('newFile'),
  deleteFile: refused('deleteFile'),
  copyFile: refused('copyFile'),
  changeFileState: refused('changeFileState'),
  changeFileDate: refused('changeFileDate'),
  openFile: refused('openFile'),
  readFile: refused('readFile'),
  writeFile: refused('writeFile'),
  closeFile: refused('closeFile'),
} satisfies Readonly<Partial<Record<CommandName, (joined: Joined) => void>>>
