// Error codes of inverter communication: what the CPU notes, what the inverter answers (H0 to HF), and which of the two
// data of an IVMC instruction it refused.
import { type EndCodeEntry, type EndCodeRow, entriesOf, FX5_SERIAL, filled } from './entry'
import type { RemedyName } from './remedies'
import type { Texts } from './texts'

const rows: readonly EndCodeRow[] = [
  [
    0x7601,
    'inverterLine',
    'Inverter communication: the inverter does not respond.',
    'インバータ通信: インバータから応答がありません。',
    '变频器通信：变频器没有响应。',
    '變頻器通訊：變頻器沒有回應。',
  ],
  [
    0x7602,
    'inverterLine',
    'Inverter communication: the inverter stopped sending half-way (time-out).',
    'インバータ通信: インバータの送信が途中で途切れました(タイムアウト)。',
    '变频器通信：变频器的发送中途中断（超时）。',
    '變頻器通訊：變頻器的傳送中途中斷（逾時）。',
  ],
  [
    0x7603,
    'inverterLine',
    'Inverter communication: another station than the one asked responded.',
    'インバータ通信: 指定した局番以外の局から応答がありました。',
    '变频器通信：收到来自非指定站的响应。',
    '變頻器通訊：收到來自非指定站的回應。',
  ],
  [
    0x7604,
    'inverterLine',
    'Inverter communication: the sum check of the data from the inverter does not match.',
    'インバータ通信: インバータの返信データのサムチェックが一致しません。',
    '变频器通信：变频器返回数据的和校验不一致。',
    '變頻器通訊：變頻器傳回資料的總和檢查不一致。',
  ],
  [
    0x7608,
    'inverterLine',
    'Inverter communication: sending to the inverter was not finished in time.',
    'インバータ通信: インバータへの送信が時間内に完了しませんでした。',
    '变频器通信：向变频器的发送未在规定时间内完成。',
    '變頻器通訊：向變頻器的傳送未在規定時間內完成。',
  ],
  [
    0x7609,
    'inverterLine',
    'Inverter communication: wrong data were received from the inverter.',
    'インバータ通信: インバータから誤ったデータを受信しました。',
    '变频器通信：从变频器收到错误的数据。',
    '變頻器通訊：從變頻器收到錯誤的資料。',
  ],
]

/** After these the inverter stops with an alarm when the permitted number of retries is exceeded. */
const stopping: Texts = [
  'Inverter communication: {}. If it goes on beyond the permitted retries, the inverter stops with an alarm.',
  'インバータ通信: {}。許容リトライ回数を超えて連続すると、インバータはアラーム停止します。',
  '变频器通信：{}。超过允许重试次数后仍连续出错时，变频器报警停止。',
  '變頻器通訊：{}。超過允許重試次數後仍連續出錯時，變頻器警報停止。',
]

/** After these the inverter does not take the data, and goes on as it was. */
const ignoring: Texts = [
  'Inverter communication: {}. The inverter does not take the data, and does not stop with an alarm.',
  'インバータ通信: {}。インバータはデータを受け付けませんが、アラーム停止しません。',
  '变频器通信：{}。变频器不接收该数据，但不报警停止。',
  '變頻器通訊：{}。變頻器不接收該資料，但不警報停止。',
]

const refusing: Texts = ['Inverter communication: {}.', 'インバータ通信: {}。', '变频器通信：{}。', '變頻器通訊：{}。']

const undefinedError: Texts = [
  'Inverter communication: the inverter sent error code {}, which present inverters do not define.',
  'インバータ通信: インバータがエラーコード{}を送信しました(現在のインバータでは未定義です)。',
  '变频器通信：变频器发送了错误代码{}（目前的变频器尚未定义）。',
  '變頻器通訊：變頻器傳送了錯誤代碼{}（目前的變頻器尚未定義）。',
]

type Answer = readonly [code: number, remedy: RemedyName, pattern: Texts, ...error: Texts]

const answers: readonly Answer[] = [
  [
    0x7620,
    'inverterLine',
    stopping,
    'error H0, computer NAK: the request data are wrong',
    'エラーH0(計算機NAKエラー)です。要求データに誤りがあります',
    '错误H0（计算机NAK错误），请求数据有误',
    '錯誤H0（電腦NAK錯誤），請求資料有誤',
  ],
  [
    0x7621,
    'inverterLine',
    stopping,
    'error H1, parity',
    'エラーH1(パリティエラー)です',
    '错误H1（奇偶校验错误）',
    '錯誤H1（同位錯誤）',
  ],
  [
    0x7622,
    'inverterLine',
    stopping,
    'error H2, sum check',
    'エラーH2(サムチェックエラー)です',
    '错误H2（和校验错误）',
    '錯誤H2（總和檢查錯誤）',
  ],
  [
    0x7623,
    'inverterLine',
    stopping,
    'error H3, protocol: wrong syntax, data not complete in time, or CR and LF not as set',
    'エラーH3(プロトコルエラー)です。データの構文誤り、時間内の受信未完了、またはCR、LFの設定不一致です',
    '错误H3（协议错误），数据语法有误、未在规定时间内接收完，或CR、LF与设置不一致',
    '錯誤H3（協定錯誤），資料語法有誤、未在規定時間內接收完，或CR、LF與設定不一致',
  ],
  [
    0x7624,
    'inverterLine',
    stopping,
    'error H4, framing: the stop bits differ from the setting',
    'エラーH4(フレーミングエラー)です。ストップビット長が設定と異なります',
    '错误H4（帧错误），停止位长度与设置不同',
    '錯誤H4（訊框錯誤），停止位元長度與設定不同',
  ],
  [
    0x7625,
    'inverterLine',
    stopping,
    'error H5, overrun: data arrived before the last were received completely',
    'エラーH5(オーバーランエラー)です。受信完了前に次のデータが送られました',
    '错误H5（溢出错误），接收完成之前收到了下一数据',
    '錯誤H5（溢位錯誤），接收完成之前收到了下一資料',
  ],
  [0x7626, 'inverterManual', undefinedError, 'H6', 'H6', 'H6', 'H6'],
  [
    0x7627,
    'program',
    ignoring,
    'error H7, a character other than 0 to 9, A to F and control codes',
    'エラーH7(キャラクタエラー)です。0～9、A～F、制御コード以外の文字を受信しました',
    '错误H7（字符错误），收到了0～9、A～F、控制代码以外的字符',
    '錯誤H7（字元錯誤），收到了0～9、A～F、控制碼以外的字元',
  ],
  [0x7628, 'inverterManual', undefinedError, 'H8', 'H8', 'H8', 'H8'],
  [0x7629, 'inverterManual', undefinedError, 'H9', 'H9', 'H9', 'H9'],
  [
    0x762a,
    'inverterMode',
    ignoring,
    'error HA, mode: a parameter was written outside computer link operation mode or while the inverter runs',
    'エラーHA(モードエラー)です。計算機リンク運転モード以外、またはインバータ運転中に書き込みました',
    '错误HA（模式错误），在非计算机链接运行模式或变频器运行中执行了写入',
    '錯誤HA（模式錯誤），在非電腦連結運轉模式或變頻器運轉中執行了寫入',
  ],
  [
    0x762b,
    'program',
    refusing,
    'error HB, there is no such instruction code',
    'エラーHB(命令コードエラー)です。存在しない命令コードが指定されました',
    '错误HB（指令代码错误），指定了不存在的指令代码',
    '錯誤HB（指令代碼錯誤），指定了不存在的指令代碼',
  ],
  [
    0x762c,
    'program',
    refusing,
    'error HC, the value of a parameter or frequency is outside its range',
    'エラーHC(データ範囲エラー)です。パラメータや運転周波数の値が設定範囲外です',
    '错误HC（数据范围错误），参数或运行频率等的值超出设置范围',
    '錯誤HC（資料範圍錯誤），參數或運轉頻率等的值超出設定範圍',
  ],
  [0x762d, 'inverterManual', undefinedError, 'HD', 'HD', 'HD', 'HD'],
  [0x762e, 'inverterManual', undefinedError, 'HE', 'HE', 'HE', 'HE'],
  [0x762f, 'inverterManual', undefinedError, 'HF', 'HF', 'HF', 'HF'],
]

type Fault = 'mode' | 'instruction' | 'range'

const faults: Readonly<Record<Fault, Texts>> = {
  mode: ['mode error', 'モードエラー', '模式错误', '模式錯誤'],
  instruction: ['instruction code error', '命令コードエラー', '指令代码错误', '指令代碼錯誤'],
  range: ['data range error', 'データ範囲エラー', '数据范围错误', '資料範圍錯誤'],
}

const patterns = {
  first: [
    'IVMC instruction: send data 1 was refused ({}); send data 2 was taken. The inverter does not stop with an alarm.',
    'IVMC命令: 送信データ1は{}です。送信データ2は受け付けられました。インバータはアラーム停止しません。',
    'IVMC指令：发送数据1为{}，发送数据2已接收。变频器不报警停止。',
    'IVMC指令：傳送資料1為{}，傳送資料2已接收。變頻器不警報停止。',
  ],
  second: [
    'IVMC instruction: send data 2 was refused ({}); send data 1 was taken. The inverter does not stop with an alarm.',
    'IVMC命令: 送信データ2は{}です。送信データ1は受け付けられました。インバータはアラーム停止しません。',
    'IVMC指令：发送数据2为{}，发送数据1已接收。变频器不报警停止。',
    'IVMC指令：傳送資料2為{}，傳送資料1已接收。變頻器不警報停止。',
  ],
  both: [
    'IVMC instruction: send data 1 ({}) and send data 2 ({}) were refused. The inverter does not stop with an alarm.',
    'IVMC命令: 送信データ1は{}、送信データ2は{}です。どちらも受け付けられません。インバータはアラーム停止しません。',
    'IVMC指令：发送数据1为{}，发送数据2为{}，均未接收。变频器不报警停止。',
    'IVMC指令：傳送資料1為{}，傳送資料2為{}，均未接收。變頻器不警報停止。',
  ],
} as const satisfies Readonly<Record<string, Texts>>

const kinds: readonly Fault[] = ['mode', 'instruction', 'range']

/** 7640H to 764EH in the order of the manual: data 1 alone, data 2 alone, then every pair. */
function ivmcEntries(): readonly EndCodeEntry[] {
  const single = (pattern: Texts) =>
    kinds.map((kind) => ({ meaning: filled(pattern, faults[kind]), remedy: remedyFor(kind) }))
  const pairs = kinds.flatMap((one) =>
    kinds.map((two) => ({
      meaning: filled(filled(patterns.both, faults[one]), faults[two]),
      remedy: remedyFor(one, two),
    })),
  )
  return [...single(patterns.first), ...single(patterns.second), ...pairs].map((texts, index) => ({
    code: 0x7640 + index,
    ...texts,
    source: FX5_SERIAL,
  }))
}

/** The mode comes first: in the wrong one nothing can be written, whatever the data. */
function remedyFor(...found: readonly Fault[]): RemedyName {
  return found.includes('mode') ? 'inverterMode' : 'program'
}

export const inverterEndCodes: readonly EndCodeEntry[] = [
  ...entriesOf(rows, FX5_SERIAL),
  ...answers.map(([code, remedy, pattern, ...error]) => ({
    code,
    meaning: filled(pattern, error),
    remedy,
    source: FX5_SERIAL,
  })),
  ...ivmcEntries(),
]
