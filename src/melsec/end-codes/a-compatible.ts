// Two-digit codes: end codes and abnormal codes of the 1E frame, NAK codes of the 1C frame. Some numbers are in both.
import { BACKGROUND, type EndCodeEntry, FX5_SERIAL } from './entry'

/** Answered with 3E frames, too. */
export const onlineChangeOff: EndCodeEntry = {
  code: 0x55,
  meaning: [
    'Writing while the CPU is in RUN is not enabled.',
    'RUN中書込みが許可されていない状態で、RUN中のCPUへの書込みが要求されました。',
    '未允许RUN中写入时，请求了对RUN中CPU的写入。',
    '未允許RUN中寫入時，請求了對RUN中CPU的寫入。',
  ],
  remedy: 'enableOnlineChange',
  source: BACKGROUND,
}

const noStation: EndCodeEntry = {
  code: 0x10,
  meaning: [
    'There is no station with this PC No.',
    '指定したPC番号の局が存在しません。',
    '指定的PC编号的站不存在。',
    '指定的PC編號的站不存在。',
  ],
  remedy: [
    'Correct the PC No.; FFH is the connected station.',
    'PC番号を修正してください。FFHは接続局です。',
    '请修正PC编号。FFH为连接站。',
    '請修正PC編號。FFH為連接站。',
  ],
  source: FX5_SERIAL,
}

const heldByOther: EndCodeEntry = {
  code: 0x18,
  meaning: [
    'Remote RUN or STOP is not possible: another device holds the CPU in STOP or PAUSE.',
    'リモートRUN/STOPができません。他の機器がリモートSTOP/PAUSEを実行中です。',
    '无法远程RUN/STOP：其他设备正在执行远程STOP/PAUSE。',
    '無法遠端RUN/STOP：其他裝置正在執行遠端STOP/PAUSE。',
  ],
  remedy: [
    'Send remote RUN from the device that stopped the CPU.',
    'リモートSTOPを行った機器からリモートRUNを実行してください。',
    '请由执行远程STOP的设备执行远程RUN。',
    '請由執行遠端STOP的裝置執行遠端RUN。',
  ],
  source: FX5_SERIAL,
}

export const endCodes1c: readonly EndCodeEntry[] = [
  {
    code: 0x02,
    meaning: ['Sum check error.', 'サムチェックエラーです。', '和校验错误。', '總和檢查錯誤。'],
    remedy: 'serialLine',
    source: FX5_SERIAL,
  },
  {
    code: 0x03,
    meaning: [
      'Protocol error: the format differs from the setting of the PLC, or there is no such command.',
      'プロトコルエラー: 形式が設定と異なるか、コマンドが存在しません。',
      '协议错误：格式与设置不同，或指令不存在。',
      '協定錯誤：格式與設定不同，或指令不存在。',
    ],
    remedy: 'serialMessage',
    source: FX5_SERIAL,
  },
  {
    code: 0x06,
    meaning: [
      'Character area error: the device does not exist, or is written with the wrong number of characters.',
      'キャラクタ部エラー: デバイスが存在しないか、桁数が誤っています。',
      '字符区错误：软元件不存在，或字符位数有误。',
      '字元區錯誤：軟元件不存在，或字元位數有誤。',
    ],
    remedy: 'correctDevice',
    source: FX5_SERIAL,
  },
  {
    code: 0x07,
    meaning: [
      'Character error: the data to write are no hexadecimal digits.',
      'キャラクタエラー: 書込みデータが16進ASCIIではありません。',
      '字符错误：写入数据不是16进制ASCII。',
      '字元錯誤：寫入資料不是16進位ASCII。',
    ],
    remedy: 'serialMessage',
    source: FX5_SERIAL,
  },
  noStation,
  heldByOther,
]

export const endCodes1e: readonly EndCodeEntry[] = [
  noStation,
  heldByOther,
  {
    code: 0x11,
    meaning: [
      'Mode error: the module and the CPU cannot exchange the request.',
      'モードエラー: ユニットとCPU間の交信が正しくありません。',
      '模式错误：模块与CPU之间的通信不正确。',
      '模式錯誤：模組與CPU之間的通訊不正確。',
    ],
    remedy: 'retryLater',
    source: BACKGROUND,
  },
  {
    code: 0x12,
    meaning: [
      'The special function module is not where the request says.',
      '指定した位置に特殊機能ユニットがありません。',
      '指定的位置没有特殊功能模块。',
      '指定的位置沒有特殊功能模組。',
    ],
    remedy: 'correctRequest',
    source: BACKGROUND,
  },
  {
    code: 0x50,
    meaning: [
      'The subheader or command is none the PLC knows.',
      'サブヘッダまたはコマンドが規定以外のコードです。',
      '副帧头或指令为规定以外的代码。',
      '副標頭或指令為規定以外的代碼。',
    ],
    remedy: [
      'Choose the frame (1E, 3E, 4E) the PLC is set to, and a command it has.',
      'PLCの設定に合ったフレーム(1E/3E/4E)と、対応するコマンドを使用してください。',
      '请选择与PLC设置相符的帧（1E/3E/4E）和支持的指令。',
      '請選擇與PLC設定相符的訊框（1E/3E/4E）和支援的指令。',
    ],
    source: BACKGROUND,
  },
  {
    code: 0x54,
    meaning: [
      'The PLC expects ASCII code and received characters that are no hexadecimal digits.',
      '交信データコードが「ASCII」のとき、バイナリに変換できないデータを受信しました。',
      '通信数据代码为“ASCII”时，收到了无法转换为二进制的数据。',
      '通訊資料代碼為「ASCII」時，收到了無法轉換為二進位的資料。',
    ],
    remedy: 'dataCode',
    source: BACKGROUND,
  },
  onlineChangeOff,
  {
    code: 0x56,
    meaning: ['The device is wrong.', 'デバイスの指定に誤りがあります。', '软元件的指定有误。', '軟元件的指定有誤。'],
    remedy: 'correctDevice',
    source: BACKGROUND,
  },
  {
    code: 0x57,
    meaning: [
      'Too many points, or the request goes beyond the highest device number, or is too short.',
      '点数が範囲外か、最大デバイス番号を超えているか、電文が短すぎます。',
      '点数超出范围，或超过最大软元件编号，或报文过短。',
      '點數超出範圍，或超過最大軟元件編號，或報文過短。',
    ],
    remedy: 'correctDevice',
    source: BACKGROUND,
  },
  {
    code: 0x58,
    meaning: [
      'The head device number is out of range, or the device does not fit the command (bit or word units, multiple of 16).',
      '先頭デバイス番号が範囲外か、デバイスがコマンドに合いません(ビット/ワード単位、16の倍数)。',
      '起始软元件编号超出范围，或软元件与指令不符（位/字单位、16的倍数）。',
      '起始軟元件編號超出範圍，或軟元件與指令不符（位元/字單位、16的倍數）。',
    ],
    remedy: 'correctDevice',
    source: BACKGROUND,
  },
  {
    code: 0x5b,
    meaning: [
      'The CPU cannot carry out the request; an abnormal code follows that says why.',
      'CPUが要求を処理できません。続く異常コードが理由を示します。',
      'CPU无法处理请求，后续的异常代码说明原因。',
      'CPU無法處理請求，後續的異常代碼說明原因。',
    ],
    remedy: 'correctRequest',
    source: 'FX5 communication manual 37.2',
  },
  {
    code: 0x60,
    meaning: [
      'The Ethernet module and the CPU did not finish within the monitoring timer.',
      'EthernetユニットとCPU間の交信時間が監視タイマ値を超えました。',
      '以太网模块与CPU之间的通信时间超过了监视定时器值。',
      '乙太網路模組與CPU之間的通訊時間超過了監視計時器值。',
    ],
    remedy: [
      'Give a longer monitoring timer.',
      '監視タイマを長くしてください。',
      '请延长监视定时器。',
      '請延長監視計時器。',
    ],
    source: BACKGROUND,
  },
]
