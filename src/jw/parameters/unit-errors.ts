// Errors that option units report about their parameters, by the codes the manual prints (JW300 option unit manual, "JW-21CM", "JW-22SU").

import type { Language } from '../../basics/texts'

/** An error of an option unit about its parameters. */
export interface UnitError {
  /** Which report it, and when. */
  readonly units: string
  /** As the unit shows it. Other units use the same number for something else. */
  readonly code: number
  /** What it says. */
  readonly meaning: Readonly<Record<Language, string>>
  /** What to do. */
  readonly remedy: Readonly<Record<Language, string>>
}

/** Errors about parameters that units in a JW300 report. */
export const unitErrors: readonly UnitError[] = [
  {
    units: 'JW-21CM, DL1 and DL9 with SW0 at 5 or 6',
    code: 0x70,
    meaning: {
      'en-US': 'The parameters of the data link are wrong: transfer bytes or areas break a rule.',
      ja: 'データリンクのパラメータの設定エラーです。転送バイト数または領域が規則に合いません。',
      'zh-CN': '数据链接的参数设置错误：传送字节数或区域不符合规则。',
      'zh-TW': '資料連結的參數設定錯誤：傳送位元組數或區域不符合規則。',
    },
    remedy: {
      'en-US': 'Check the bytes of each station, their sum, and whether offsets and bytes stay within the area.',
      ja: '各局のバイト数とその合計、およびオフセットとバイト数が領域に収まることを確認してください。',
      'zh-CN': '请确认各站的字节数及其合计，以及偏移与字节数是否在区域内。',
      'zh-TW': '請確認各站的位元組數及其合計，以及偏移與位元組數是否在區域內。',
    },
  },
  {
    units: 'JW-22SU',
    code: 0x3c,
    meaning: {
      'en-US': 'The address of the control relays is out of range.',
      ja: '制御リレーアドレスの設定が範囲外です。',
      'zh-CN': '控制继电器地址的设置超出范围。',
      'zh-TW': '控制繼電器位址的設定超出範圍。',
    },
    remedy: {
      'en-US': 'Set the address of the control relays within the memory of the CU, and parameter 0042 to 0.',
      ja: '制御リレーアドレスを CU のメモリの範囲内に設定し、パラメータアドレス 0042 を 0 にしてください。',
      'zh-CN': '请将控制继电器地址设置在 CU 的存储器范围内，并将参数地址 0042 设为 0。',
      'zh-TW': '請將控制繼電器位址設定在 CU 的記憶體範圍內，並將參數位址 0042 設為 0。',
    },
  },
  {
    units: 'JW-22SU',
    code: 0x7f,
    meaning: {
      'en-US': 'The sum check of the parameters does not match: they may have been destroyed.',
      ja: 'パラメータのチェックサムエラーです。パラメータが破壊された可能性があります。',
      'zh-CN': '参数的校验和错误：参数可能已损坏。',
      'zh-TW': '參數的校驗和錯誤：參數可能已損壞。',
    },
    remedy: {
      'en-US': 'Write the right parameters again.',
      ja: '正しいパラメータを再設定してください。',
      'zh-CN': '请重新设置正确的参数。',
      'zh-TW': '請重新設定正確的參數。',
    },
  },
]
