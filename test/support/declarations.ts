/** Every declaration of this package, in every code and form it is sent in. */
import type { DataCode, Declaration, Shape } from '../../src/codec/codec'
import { jwCommands } from '../../src/jw/commands/commands'
import { markerForms } from '../../src/jw/commands/data-memory'
import { aCompatibleCommands } from '../../src/melsec/a-compatible/commands'
import type { MelsecDeclaration } from '../../src/melsec/commands/command'
import { commands } from '../../src/melsec/commands/commands'
import { fileCommands } from '../../src/melsec/commands/file'
import { FORM_EXTENDED, FORM_LONG, FORM_XY_OCTAL, FORM_ZR_HEX } from '../../src/melsec/device/codec'
import { oneCCommands } from '../../src/melsec/one-c/commands'
import { fileCommandNames } from '../../src/melsec/profiles/files'

export interface DeclarationCase {
  /** e.g. `melsec readWords ascii` */
  readonly title: string
  readonly declaration: Declaration
  /** The request that its response refers to: its own or, for Execute Monitor, the registration's. */
  readonly asked: Shape
  readonly code: DataCode
  readonly forms: readonly number[]
}

interface Family {
  readonly list: Readonly<Record<string, Declaration>>
  readonly forms: Readonly<Partial<Record<DataCode, readonly number[]>>>
}

const deviceForms = [0, FORM_LONG, FORM_EXTENDED, FORM_EXTENDED | FORM_LONG]
const digits = [0, FORM_XY_OCTAL, FORM_ZR_HEX, FORM_XY_OCTAL | FORM_ZR_HEX]

/** File commands: their form is their subcommand, all of those that any of them takes. */
const fileForms = [...new Set(fileCommandNames.flatMap((name) => subcommandsOf(commands[name])))]

function subcommandsOf(command: MelsecDeclaration): readonly number[] {
  return command.subcommands ?? [0]
}

const deviceCommands = Object.fromEntries(Object.entries(commands).filter(([name]) => !(name in fileCommands)))

const families: Readonly<Record<string, Family>> = {
  melsec: {
    list: deviceCommands,
    forms: { binary: deviceForms, ascii: deviceForms.flatMap((form) => digits.map((digit) => form | digit)) },
  },
  files: { list: fileCommands, forms: { binary: fileForms, ascii: fileForms } },
  '1E': { list: aCompatibleCommands, forms: { binary: [0], ascii: [0, FORM_XY_OCTAL] } },
  '1C': { list: oneCCommands, forms: { ascii: [0, FORM_XY_OCTAL] } },
  jw: { list: jwCommands, forms: { binary: Object.values(markerForms) } },
}

export const declarationCases: readonly DeclarationCase[] = Object.entries(families).flatMap(
  ([family, { list, forms }]) =>
    Object.entries(list).flatMap(([name, declaration]) => {
      const asked = declaration.context === undefined ? declaration : list[declaration.context]
      if (asked === undefined) throw new Error(`${name} refers to a command that is not declared`)
      return (Object.keys(forms) as DataCode[]).map((code) => ({
        title: `${family} ${name} ${code}`,
        declaration,
        asked: asked.request,
        code,
        forms: forms[code] ?? [],
      }))
    }),
)
