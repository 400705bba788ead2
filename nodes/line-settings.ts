// The settings of a serial line as a flow stores them, and the options made of them.
import { baudRates, type MelsecLineOptions, type SerialPortOptions, serialFrameNames } from '../src/index'
import { Fields, present, type SettingsContext } from './fields'
import type { Texts } from './texts'

/** What the editor stores. Numbers are text as typed, `''` is the default, and any text may hold `${NAME}`. */
const TEXT_FIELDS = [
  'transport',
  'path',
  'host',
  'port',
  'baudRate',
  'dataLength',
  'parity',
  'stopBits',
  'rts',
  'frame',
  'messageFormat',
  'answerTime',
  'betweenBytes',
  'quiet',
  'gap',
  'echo',
  'connectTimeout',
  'etxInSum',
  'sumOfAck',
  'errorDigits',
  'errorInformation',
  'initialise',
] as const
type TextField = (typeof TEXT_FIELDS)[number]

/** A stored line. */
export interface LineSettings extends Readonly<Record<TextField, string>> {
  /** Anything but `false` switches it on, as in the library: without it a damaged character is not noticed. */
  readonly sumCheck: boolean
}

/** How the settings of a line are read: what its dialog calls its fields stands in its own catalogue. */
export interface LineContext extends SettingsContext {
  readonly labels: Texts
}

function fieldsOf({ texts, labels }: Pick<LineContext, 'texts' | 'labels'>): Fields<TextField> {
  return new Fields(texts, (field) => labels(`label.${field}`), 'error.missingInLine')
}

/** @throws NodeFailure NOT_CONFIGURED naming the field that is no text */
export function lineSettingsOf(given: Readonly<Record<string, unknown>>, context: LineContext): LineSettings {
  return {
    ...fieldsOf(context).textsOf(given, TEXT_FIELDS, context.resolve),
    sumCheck: given.sumCheck !== false,
  }
}

/**
 * The options of a line. Ranges and combinations are the library's business; here only texts become numbers.
 * @throws NodeFailure NOT_CONFIGURED naming the field
 */
export function lineOptionsOf(
  settings: LineSettings,
  context: Pick<LineContext, 'texts' | 'labels'>,
): MelsecLineOptions {
  const fields = fieldsOf(context)
  const isRemote = fields.choice(settings, 'transport', ['serial', 'tcp']) === 'tcp'
  const place = isRemote
    ? {
        host: settings.host === '' ? fields.missing('host') : settings.host,
        port: fields.wholeNumber(settings, 'port') ?? fields.missing('port'),
      }
    : {}
  const path = isRemote ? undefined : settings.path === '' ? fields.missing('path') : settings.path
  return {
    ...place,
    ...formatOf(settings, fields),
    ...present({ connectTimeout: fields.wholeNumber(settings, 'connectTimeout') }),
    serial: { ...present({ path }), ...portOf(settings, fields) },
  }
}

/** How the frames look: enough to read addresses. */
function formatOf(settings: LineSettings, fields: Fields<TextField>): MelsecLineOptions {
  return {
    ...present({
      frame: fields.choice(settings, 'frame', serialFrameNames),
      messageFormat: fields.numberOf(settings, 'messageFormat', [1, 4, 5]),
    }),
    sumCheck: settings.sumCheck,
    serialFrame: present({
      etxInSum: fields.switch(settings, 'etxInSum'),
      sumOfAck: fields.switch(settings, 'sumOfAck'),
      errorDigits: fields.numberOf(settings, 'errorDigits', [2, 4]),
      errorInformation: fields.switch(settings, 'errorInformation'),
      initialise: fields.choice(settings, 'initialise', ['EOT', 'CL']),
    }),
  }
}

function portOf(settings: LineSettings, fields: Fields<TextField>): SerialPortOptions {
  return present({
    baudRate: fields.numberOf(settings, 'baudRate', baudRates),
    dataLength: fields.numberOf(settings, 'dataLength', [7, 8]),
    parity: fields.choice(settings, 'parity', ['none', 'odd', 'even']),
    stopBits: fields.numberOf(settings, 'stopBits', [1, 2]),
    rts: fields.choice(settings, 'rts', ['on', 'off', 'sending']),
    answerTime: fields.wholeNumber(settings, 'answerTime'),
    betweenBytes: fields.wholeNumber(settings, 'betweenBytes'),
    quiet: fields.wholeNumber(settings, 'quiet'),
    gap: fields.wholeNumber(settings, 'gap'),
    echo: fields.choice(settings, 'echo', ['auto', 'always', 'never']),
  })
}
