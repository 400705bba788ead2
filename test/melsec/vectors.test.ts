import { describe, expect, test } from '@jest/globals'
import { type Context, decode, encode, measure, readerOf, type Shape, sumOf, writerOf } from '../../src/codec/codec'
import { commands } from '../../src/melsec/commands/commands'
import { knownCommands } from '../../src/melsec/commands/known'
import { deviceAddress, FORM_EXTENDED, FORM_LONG, FORM_XY_OCTAL } from '../../src/melsec/device/codec'
import type { DeviceAddress, DeviceName } from '../../src/melsec/device/device'
import { FORM_BITS, readSubcommand, subcommandOf } from '../../src/melsec/device/form'
import { resolveProfile } from '../../src/melsec/profiles/profiles'
import { bytesOf, type Form, type Message, plain, type Vector, vectorsOfKind } from '../vectors/vectors'

const profile = resolveProfile('generic')
const FAMILIES = ['slmp', 'mc-serial'] as const
const HEAD = { binary: 4, ascii: 8 } as const

type Coded = { readonly code: 'binary' | 'ascii'; readonly form?: Form; readonly xyRadix?: 8 }

function bitsOf({ form = 'short', xyRadix }: Coded): number {
  return FORM_BITS[form] | (xyRadix === 8 ? FORM_XY_OCTAL : 0)
}

function commandOf(name: string) {
  const command = knownCommands[name as keyof typeof knownCommands]
  if (command === undefined) throw new Error(`No command ${name} is declared`)
  return command
}

/** Command, subcommand and data. */
function requestData(vector: Coded & { readonly command: string; readonly message: Message }): Buffer {
  const command = commandOf(vector.command)
  const writer = writerOf(vector.code, bitsOf(vector))
  writer.uint(command.code, 2)
  writer.uint(subcommandOf(command, vector.form ?? 'short', profile), 2)
  encode<Shape>(command.request, vector.message, writer)
  return writer.take()
}

function data(shape: Shape, message: Message, coded: Coded, context?: Context): Buffer {
  const writer = writerOf(coded.code, bitsOf(coded))
  encode<Shape>(shape, message, writer, context)
  return writer.take()
}

describe.each(FAMILIES)('request data of %s', (family) => {
  const vectors = vectorsOfKind(family, 'requestData')

  test.each(vectors)('$id is encoded as printed', (vector) => {
    expect(requestData(vector).toString('hex')).toBe(vector.hex)
  })

  test.each(vectors)('$id is decoded to its meaning', (vector) => {
    const command = commandOf(vector.command)
    const reader = readerOf(vector.code, bytesOf(vector), bitsOf(vector))
    expect(reader.uint(2)).toBe(command.code)
    const subcommand = reader.uint(2)
    if (command.unit === 'none') expect(subcommand).toBe(0)
    else expect(readSubcommand(subcommand)).toEqual({ unit: command.unit, form: vector.form })
    expect(plain(decode<Shape>(command.request, reader))).toEqual(vector.message)
    reader.end()
  })

  test.each(vectors)('$id is measured without encoding it', (vector) => {
    const known = { ascii: vector.code === 'ascii', form: bitsOf(vector), message: vector.message }
    expect(measure(commandOf(vector.command).request, known)).toBe(bytesOf(vector).length - HEAD[vector.code])
  })

  test.each(vectors)('$id is refused one byte short and one byte long', (vector) => {
    const { request } = commandOf(vector.command)
    const body = bytesOf(vector).subarray(HEAD[vector.code])
    const read = (bytes: Buffer) => {
      const reader = readerOf(vector.code, bytes, bitsOf(vector))
      decode<Shape>(request, reader)
      reader.end()
    }
    if (body.length > 0) expect(() => read(body.subarray(0, -1))).toThrow(/needs .* more byte/)
    expect(() => read(Buffer.concat([body, Buffer.of(0x30)]))).toThrow(/left over/)
  })
})

describe.each(FAMILIES)('response data of %s', (family) => {
  const vectors = vectorsOfKind(family, 'responseData')

  function contextOf(vector: (typeof vectors)[number]): Context {
    const { registration } = vector
    if (registration !== undefined) return { shape: commands.entryMonitorDevice.request, message: registration }
    return { shape: commandOf(vector.command).request, message: vector.request }
  }

  test.each(vectors)('$id is encoded as printed', (vector) => {
    const { response } = commandOf(vector.command)
    expect(data(response, vector.message, vector, contextOf(vector)).toString('hex')).toBe(vector.hex)
  })

  test.each(vectors)('$id is decoded to its meaning', (vector) => {
    const reader = readerOf(vector.code, bytesOf(vector), bitsOf(vector))
    expect(plain(decode<Shape>(commandOf(vector.command).response, reader, contextOf(vector)))).toEqual(vector.message)
    reader.end()
  })

  test.each(vectors)('$id is measured from its request', (vector) => {
    const known = {
      ascii: vector.code === 'ascii',
      form: bitsOf(vector),
      context: contextOf(vector),
    }
    expect(measure(commandOf(vector.command).response, known)).toBe(bytesOf(vector).length)
  })
})

describe.each(FAMILIES)('beginnings of request data of %s', (family) => {
  test.each(vectorsOfKind(family, 'prefix'))('$id is what the request begins with', (vector) => {
    expect(requestData(vector).toString('hex').slice(0, vector.hex.length)).toBe(vector.hex)
  })
})

/** A device specification as it is written. */
function written(address: DeviceAddress, coded: Coded): Buffer {
  const writer = writerOf(coded.code, bitsOf(coded))
  deviceAddress.write(writer, address)
  return writer.take()
}

/** Bytes of the code within a device specification that has no extension: in front in ASCII code, behind in binary. */
function splitDevice(bytes: Buffer, code: Coded['code'], form: Form): { code: Buffer; number: Buffer } {
  const size = (form === 'long' ? 2 : 1) * (code === 'ascii' ? 2 : 1)
  return code === 'ascii'
    ? { code: bytes.subarray(0, size), number: bytes.subarray(size) }
    : { code: bytes.subarray(-size), number: bytes.subarray(0, -size) }
}

function formOfDevice({ id, form }: { readonly id: string; readonly form?: Form }): Form {
  if (form === undefined) throw new Error(`${id} has no form`)
  return form
}

describe.each(FAMILIES)('devices of %s', (family) => {
  test.each(vectorsOfKind(family, 'deviceCode'))('$id: code of $device', (vector) => {
    const form = formOfDevice(vector)
    const bytes = written({ device: vector.device, number: 0 }, vector)
    const { code, number } = splitDevice(bytes, vector.code, form)
    expect(code.toString('hex')).toBe(vector.hex)
    const whole = vector.code === 'ascii' ? [code, number] : [number, code]
    const reader = readerOf(vector.code, Buffer.concat(whole), bitsOf(vector))
    expect(deviceAddress.read(reader)).toEqual({ device: vector.device, number: 0 })
  })

  test.each(vectorsOfKind(family, 'deviceNumber'))('$id: number $device $number', (vector) => {
    const bytes = written({ device: vector.device, number: vector.number }, vector)
    expect(splitDevice(bytes, vector.code, vector.form).number.toString('hex')).toBe(vector.hex)
  })

  test.each(vectorsOfKind(family, 'device'))('$id: subcommand and device specification', (vector) => {
    const subcommand = writerOf(vector.code)
    subcommand.uint(vector.subcommand, 2)
    expect(readSubcommand(vector.subcommand)).toEqual({ unit: 'word', form: vector.form })
    const bytes = Buffer.concat([subcommand.take(), written(vector.address, vector)])
    expect(bytes.toString('hex').slice(0, vector.hex.length)).toBe(vector.hex)
    if (vector.complete !== false) expect(bytes).toHaveLength(bytesOf(vector).length)
    const reader = readerOf(vector.code, bytes.subarray(vector.code === 'ascii' ? 4 : 2), bitsOf(vector))
    expect(deviceAddress.read(reader)).toEqual(vector.address)
    reader.end()
  })

  test.each(vectorsOfKind(family, 'extension'))('$id: extension $extension.kind', (vector) => {
    const device: DeviceName = vector.extension.kind === 'link' ? 'W' : 'G'
    const bytes = written({ device, number: 0, extension: vector.extension }, { ...vector, form: 'extendedShort' })
    // ASCII: 00, extension …; binary: … extension, direct memory (SLMP reference manual, appendix 1).
    const found = vector.code === 'ascii' ? bytes.subarray(2, 6) : bytes.subarray(-3, -1)
    expect(found.toString('hex')).toBe(vector.hex)
  })
})

describe('fields of commands', () => {
  const fields = FAMILIES.flatMap((family) => vectorsOfKind(family, 'field'))
  const of = (name: string) => fields.filter((vector) => vector.fields[0]?.name === name)
  const value = (vector: Vector & { kind: 'field' }) => vector.fields[0]?.value ?? Number.NaN
  const D0 = { device: 'D', number: 0 }

  test.each(of('subcommand'))('$id: subcommand', (vector) => {
    const command = commandOf(vector.command ?? '')
    const writer = writerOf(vector.code)
    writer.uint(subcommandOf(command, formOfDevice(vector), profile), 2)
    expect(writer.take().toString('hex')).toBe(vector.hex)
    expect(readSubcommand(value(vector))).toEqual({ unit: command.unit, form: vector.form })
  })

  test.each(of('points'))('$id: number of device points', (vector) => {
    const bytes = data(commands.readWords.request, { head: D0, points: value(vector) }, vector)
    expect(bytes.toString('hex').endsWith(vector.hex)).toBe(true)
  })

  test.each([...of('bitAccessPoints'), ...of('accessPoints'), ...of('blocks')])('$id: one-byte count', (vector) => {
    const name = vector.fields[0]?.name
    const elements = Array.from({ length: value(vector) }, () => D0)
    const bytes =
      name === 'blocks'
        ? data(
            commands.readBlock.request,
            { wordBlocks: elements.map((head) => ({ head, points: 1 })), bitBlocks: [] },
            vector,
          )
        : name === 'accessPoints'
          ? data(
              commands.readRandom.request,
              { words: elements.map((device) => ({ device })), doubleWords: [] },
              vector,
            )
          : data(
              commands.writeRandomBits.request,
              { bits: elements.map(({ number }) => ({ device: { device: 'M', number }, value: true })) },
              vector,
            )
    expect(bytes.toString('hex').startsWith(vector.hex)).toBe(true)
  })

  test.each(of('setReset'))('$id: set/reset', (vector) => {
    const message = { bits: [{ device: { device: 'M', number: 0 }, value: value(vector) === 1 }] }
    const bytes = data(commands.writeRandomBits.request, message, vector)
    expect(bytes.toString('hex').endsWith(vector.hex)).toBe(true)
    expect(decode<Shape>(commands.writeRandomBits.request, readerOf(vector.code, bytes, bitsOf(vector)))).toEqual(
      message,
    )
  })

  test.each(of('mode'))('$id: mode of $command', (vector) => {
    const bytes = data(commandOf(vector.command ?? '').request, { mode: value(vector) }, vector)
    expect(bytes.toString('hex').startsWith(vector.hex)).toBe(true)
  })

  test.each([...of('bufferAddress'), ...of('wordLength'), ...of('bufferWord')])('$id: Memory', (vector) => {
    const name = vector.fields[0]?.name
    const address = name === 'bufferAddress' ? value(vector) : 0
    const count = name === 'wordLength' ? value(vector) : 1
    const values = Array.from({ length: count }, () => (name === 'bufferWord' ? value(vector) : 0))
    const bytes = data(commands.writeMemory.request, { address, values }, vector)
    const unit = vector.code === 'ascii' ? 2 : 1
    const at = { bufferAddress: 0, wordLength: 4 * unit, bufferWord: 6 * unit }[name as 'wordLength']
    expect(bytes.subarray(at, at + bytesOf(vector).length).toString('hex')).toBe(vector.hex)
  })

  test.each(of('moduleNumber'))('$id: module No. of Extend Unit', (vector) => {
    const message = { address: 0, byteCount: 2, moduleNumber: value(vector) }
    expect(data(commands.readExtendUnit.request, message, vector).toString('hex').endsWith(vector.hex)).toBe(true)
  })

  test.each(of('passwordLength'))('$id: length of the remote password', (vector) => {
    const bytes = data(commands.unlock.request, { password: 'p'.repeat(value(vector)) }, vector)
    expect(bytes.toString('hex').startsWith(vector.hex)).toBe(true)
  })

  test.each(of('clearMode'))('$id: clear mode', (vector) => {
    const bytes = data(commands.remoteRun.request, { mode: 1, clearMode: value(vector) }, vector)
    const at = vector.code === 'ascii' ? 4 : 2
    expect(bytes.subarray(at, at + bytesOf(vector).length).toString('hex')).toBe(vector.hex)
  })

  test.each(of('directMemory'))('$id: direct memory specification of $extensionKind', (vector) => {
    const where = {
      link: { device: 'W', number: 0, extension: { kind: 'link', network: 1 } },
      module: { device: 'G', number: 0, extension: { kind: 'module', unit: 1 } },
      cpu: { device: 'G', number: 0, extension: { kind: 'cpu', cpu: 1 } },
    } as const
    const address = where[vector.extensionKind ?? 'link']
    expect(
      written(address, { ...vector, form: 'extendedLong' })
        .toString('hex')
        .slice(-2),
    ).toBe(vector.hex)
  })

  test('every field is tested here or as a part of a frame', () => {
    const here = ['subcommand', 'points', 'bitAccessPoints', 'accessPoints', 'blocks', 'setReset', 'mode', 'clearMode']
    const texts = ['passwordLength', 'bufferAddress', 'wordLength', 'bufferWord', 'moduleNumber']
    const frame = ['network', 'station', 'moduleIo', 'multidrop', 'requestDataLength', 'responseDataLength', 'timer']
    const serial = ['endCode', 'dataBytes', 'frameId', 'pc', 'selfStation', 'directMemory']
    for (const { fields: parts } of fields) expect([...here, ...texts, ...frame, ...serial]).toContain(parts[0]?.name)
  })
})

describe('form bits', () => {
  test('are the subcommand bits', () => {
    expect([FORM_LONG, FORM_EXTENDED]).toEqual([0x02, 0x80])
  })
})

describe('sum check code', () => {
  test.each(vectorsOfKind('mc-serial', 'sum'))('$id', (vector) => {
    const sum = sumOf(Buffer.from(vector.over, 'hex'))
    expect(Buffer.from(sum.toString(16).toUpperCase().padStart(2, '0')).toString('hex')).toBe(vector.hex)
  })
})
