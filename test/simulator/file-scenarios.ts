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

function answered<T>(answer: T | undefined): T {
  if (answer === undefined) throw new Error('no answer')
  return answer
}

const content = (plc: Joined['plc'], file: string) => plc.files.read(4, file)

/** Makes a file of two bytes and opens it. */
function opened({ asker }: Joined, mode: 0 | 0x100): number {
  asker.ask(commands.newFile, { ...at, size: 2 })
  return answered(asker.ask(commands.openFile, { ...at, mode })).pointer
}

export const fileScenarios = {
  readDirectory({ asker, plc }) {
    const { files, lastFileNumber } = answered(asker.ask(commands.readDirectory, { drive: 4, start: 1, count: 36 }))
    expect(files.map((file) => file.name)).toEqual(expect.arrayContaining(['README.TXT', 'LINE.CSV']))
    const line = files.find((file) => file.name === 'LINE.CSV')
    expect(line).toMatchObject({
      attribute: 0x20,
      size: content(plc, 'LINE.CSV')?.length,
      modified: { year: 2026, month: 1, day: 15, hour: 8 },
    })
    const rest = asker.ask(commands.readDirectory, { drive: 4, start: files.length + 1, count: 36 })
    expect(rest).toEqual({ files: [], lastFileNumber })
  },
  searchFile({ asker }) {
    const { files } = answered(asker.ask(commands.readDirectory, { drive: 4, start: 1, count: 36 }))
    const { fileNumber } = answered(asker.ask(commands.searchFile, { drive: 4, name: 'line.csv' }))
    expect(files[fileNumber - 1]?.name).toBe('LINE.CSV')
  },
  newFile({ asker, plc }) {
    expect(asker.ask(commands.newFile, { ...at, size: 3 })).toEqual({})
    expect(content(plc, name)).toEqual(Buffer.alloc(3))
    expect(asker.endCode(commands.newFile, { ...at, size: 3 })).toBe(0x4028)
  },
  deleteFile({ asker, plc }) {
    expect(asker.ask(commands.deleteFile, { drive: 4, name: 'LINE.CSV' })).toEqual({})
    expect(content(plc, 'LINE.CSV')).toBeUndefined()
  },
  copyFile({ asker, plc }) {
    const copy = { destinationDrive: 2, destinationName: 'COPY.CSV', sourceDrive: 4, sourceName: 'LINE.CSV' }
    expect(asker.ask(commands.copyFile, copy)).toEqual({})
    expect(plc.files.read(2, 'COPY.CSV')).toEqual(content(plc, 'LINE.CSV'))
  },
  changeFileState({ asker }) {
    const attribute = () =>
      answered(asker.ask(commands.readDirectory, { drive: 4, start: 1, count: 36 })).files.find(
        (file) => file.name === 'LINE.CSV',
      )?.attribute
    expect(asker.ask(commands.changeFileState, { drive: 4, name: 'LINE.CSV', attribute: 1 })).toEqual({})
    expect(attribute()).toBe(1)
    expect(asker.ask(commands.changeFileState, { drive: 4, name: 'LINE.CSV', attribute: 0x20 })).toEqual({})
    expect(attribute()).toBe(0x20)
  },
  changeFileDate({ asker }) {
    expect(asker.ask(commands.changeFileDate, { drive: 4, name: 'LINE.CSV', date })).toEqual({})
    const { files } = answered(asker.ask(commands.readDirectory, { drive: 4, start: 1, count: 36 }))
    expect(files.find((file) => file.name === 'LINE.CSV')?.modified).toEqual(date)
  },
  openFile(joined) {
    const { asker, plc } = joined
    expect(opened(joined, 0)).toBe(0)
    expect(asker.ask(commands.openFile, { ...at, mode: 0 })).toEqual({ pointer: 1 })
    expect(asker.endCode(commands.openFile, { ...at, mode: 0x100 })).not.toBe(0)
    expect(plc.files.open.map(({ mode }) => mode)).toEqual(['read', 'read'])
  },
  readFile(joined) {
    const { asker, plc } = joined
    const pointer = opened(joined, 0)
    plc.files.write(4, name, Buffer.of(1, 2, 3, 4))
    expect(asker.ask(commands.readFile, { pointer, offset: 2, byteCount: 2 })).toEqual({ data: Buffer.of(3, 4) })
  },
  writeFile(joined) {
    const pointer = opened(joined, 0x100)
    expect(joined.asker.ask(commands.writeFile, { pointer, offset: 0, data: Buffer.of(0xab, 0xcd) })).toEqual({
      written: 2,
    })
    expect(content(joined.plc, name)).toEqual(Buffer.of(0xab, 0xcd))
  },
  closeFile(joined) {
    const pointer = opened(joined, 0x100)
    expect(joined.asker.ask(commands.closeFile, { pointer })).toEqual({})
    expect(joined.plc.files.open).toEqual([])
  },
} satisfies Readonly<Partial<Record<CommandName, (joined: Joined) => void>>>
