// Where a code is seen: in an answer, or only in a register or history of the PLC. The lists are the tables of the FX5
// communication manual (section 47); 4000H to 4FFFH and what FX5 lacks are answered by Q, L and iQ-R modules, too.
import type { Codes } from '../../link/link'
import type { MelsecEndCodeFamily } from './family'
import type { Texts } from './texts'

export interface EndCodePlace {
  readonly name: string
  /** Default `slmp`. */
  readonly family?: MelsecEndCodeFamily
  /** What kind of code it is and where it is found, in whole sentences. */
  readonly text: Texts
  /** The answer to a request carries it. */
  readonly answer: boolean
  readonly codes: Codes
}

const socket: Codes = [0xc020, 0xc024, 0xc025, 0xc027, 0xc029, 0xc04c, 0xc0b6, 0xc0de]
const dedicatedInstruction: Codes = [
  0xc1a6,
  0xc1ac,
  0xc1ad,
  [0xc1af, 0xc1b4],
  0xc1ba,
  0xc1c6,
  0xc1cc,
  0xc1cd,
  0xc1d0,
  0xc1d3,
]
const predefinedProtocol: Codes = [0xc400, 0xc401, 0xc404, 0xc405, 0xc410, 0xc411, 0xc417, 0xc431]
const iqss: Codes = [[0xcee0, 0xcee2], 0xcf10, 0xcf20, 0xcf30, 0xcf31, 0xcf70, 0xcf71]
const simplePlcLink: Codes = [[0x7701, 0x7705], 0x7711, 0x7714, 0x7715, [0x7721, 0x7723], 0x7731]
const serialProtocol: Codes = [
  0x7d00,
  0x7d02,
  0x7d10,
  0x7d12,
  0x7d13,
  [0x7d16, 0x7d1b],
  0x7d20,
  0x7d21,
  0x7f20,
  0x7f24,
  [0x7f67, 0x7f6a],
  0x7ff2,
]
const inverter: Codes = [[0x7601, 0x7604], 0x7608, 0x7609, [0x7620, 0x762f], [0x7640, 0x764e]]
/** Of a 1C frame the CPU notes these, the answer carries a two-digit code. */
const frame1c: Codes = [
  0x7001,
  0x7010,
  0x7143,
  0x7164,
  [0x7e40, 0x7e43],
  [0x7f21, 0x7f24],
  0x7f26,
  0x7f40,
  [0x7f67, 0x7f69],
]

export const endCodePlaces: readonly EndCodePlace[] = [
  {
    name: '3E',
    text: [
      'End code in the answer to a request with 3E or 4E frame.',
      '3E/4Eフレームの応答に入る終了コードです。',
      '3E/4E帧的响应中的结束代码。',
      '3E/4E訊框的回應中的結束代碼。',
    ],
    answer: true,
    codes: [
      0x0000,
      0x0055,
      [0x4000, 0x4fff],
      0xc035,
      0xc040,
      [0xc050, 0xc061],
      [0xc070, 0xc073],
      0xc075,
      0xc0b2,
      0xc0b5,
      0xc0d3,
      0xc0d4,
      0xc0d8,
      0xc0d9,
      0xc1a2,
      0xc1a4,
      0xc1a5,
      [0xc1a7, 0xc1aa],
      [0xc200, 0xc205],
      0xc207,
      0xc208,
      0xc810,
      0xc815,
      0xc816,
    ],
  },
  {
    name: '1E',
    family: '1E',
    text: [
      'End code or abnormal code in the answer to a request with 1E frame.',
      '1Eフレームの応答に入る終了コードまたは異常コードです。',
      '1E帧的响应中的结束代码或异常代码。',
      '1E訊框的回應中的結束代碼或異常代碼。',
    ],
    answer: true,
    codes: [0x10, 0x11, 0x12, 0x18, 0x50, [0x54, 0x58], 0x5b, 0x60],
  },
  {
    name: '1C',
    family: '1C',
    text: [
      'Error code (two digits) of a NAK answer with 1C frame.',
      '1CフレームのNAK応答に入るエラーコード(2桁)です。',
      '1C帧的NAK响应中的错误代码（2位）。',
      '1C訊框的NAK回應中的錯誤代碼（2位）。',
    ],
    answer: true,
    codes: [0x02, 0x03, 0x06, 0x07, 0x10, 0x18],
  },
  {
    name: '3C/4C',
    text: [
      'Error code (four digits) of a NAK answer with 3C or 4C frame.',
      '3C/4CフレームのNAK応答に入るエラーコード(4桁)です。',
      '3C/4C帧的NAK响应中的错误代码（4位）。',
      '3C/4C訊框的NAK回應中的錯誤代碼（4位）。',
    ],
    answer: true,
    codes: [
      [0x4000, 0x4fff],
      0x7143,
      0x7155,
      0x7157,
      0x7164,
      0x7167,
      0x7168,
      [0x7e40, 0x7e43],
      0x7e47,
      [0x7f21, 0x7f24],
      0x7f26,
      0x7f40,
      [0x7f67, 0x7f69],
      0x7fe6,
    ],
  },
  {
    name: 'serial channel',
    text: [
      'Serial communication error code of an FX5 CPU module: SD8500, SD8510, SD8520 or SD8530 (channel 1 to 4).',
      'FX5 CPUのシリアル通信エラーコードです: SD8500、SD8510、SD8520、SD8530(CH1～CH4)。',
      'FX5 CPU的串行通信错误代码：SD8500、SD8510、SD8520、SD8530（通道1～4）。',
      'FX5 CPU的序列通訊錯誤代碼：SD8500、SD8510、SD8520、SD8530（通道1～4）。',
    ],
    answer: false,
    codes: [
      0x0000,
      0x2220,
      0x2221,
      0x7200,
      0x7201,
      [0x7304, 0x730e],
      [0x7812, 0x7814],
      ...frame1c,
      ...inverter,
      ...simplePlcLink,
      ...serialProtocol,
    ],
  },
  {
    name: 'N:N network',
    text: [
      'Data transfer sequence error code of the N:N network: SD9061 (master) and SD9062 to SD9068 (local stations).',
      '簡易PC間リンクのデータ転送シーケンスエラーのエラーコードです: SD9061(マスタ局)、SD9062～SD9068(ローカル局)。',
      '简易PLC间链接的数据传送序列错误代码：SD9061（主站）、SD9062～SD9068（本地站）。',
      '簡易PLC間連結的資料傳送序列錯誤代碼：SD9061（主站）、SD9062～SD9068（本地站）。',
    ],
    answer: false,
    codes: simplePlcLink,
  },
  {
    name: 'S(P).CPRTCL',
    text: [
      'Result of the S(P).CPRTCL instruction (predefined protocol support).',
      'S(P).CPRTCL命令(通信プロトコル支援機能)の実行結果に入ります。',
      'S(P).CPRTCL指令（通信协议支持功能）的执行结果。',
      'S(P).CPRTCL指令（通訊協定支援功能）的執行結果。',
    ],
    answer: false,
    codes: serialProtocol,
  },
  {
    name: 'operation error',
    text: [
      'Operation error code of an FX5 CPU module: SD0, SD8067.',
      'FX5 CPUの演算エラーコードです: SD0、SD8067。',
      'FX5 CPU的运算错误代码：SD0、SD8067。',
      'FX5 CPU的運算錯誤代碼：SD0、SD8067。',
    ],
    answer: false,
    codes: [0x1810, [0x2220, 0x2222], 0x2250, 0x2820, 0x2822, 0x3100, 0x3405, 0x3582, 0x3600],
  },
  {
    name: 'IP address change',
    text: [
      'Error code of the IP address change: SD8498 and SD8499; on an Ethernet module Un\\G61 and Un\\G62.',
      'IPアドレス変更のエラーコードです: SD8498、SD8499(EthernetユニットではUn\\G61、Un\\G62)。',
      'IP地址更改的错误代码：SD8498、SD8499（以太网模块为Un\\G61、Un\\G62）。',
      'IP位址變更的錯誤代碼：SD8498、SD8499（乙太網路模組為Un\\G61、Un\\G62）。',
    ],
    answer: false,
    codes: [0x1920, 0x1921],
  },
  {
    name: 'simple CPU communication',
    text: [
      'Error code of simple CPU communication: SD10412 to SD10443; on an Ethernet module Un\\G416 to Un\\G447.',
      'シンプルCPU通信のエラーコードです: SD10412～SD10443(EthernetユニットではUn\\G416～Un\\G447)。',
      '简单CPU通信的错误代码：SD10412～SD10443（以太网模块为Un\\G416～Un\\G447）。',
      '簡單CPU通訊的錯誤代碼：SD10412～SD10443（乙太網路模組為Un\\G416～Un\\G447）。',
    ],
    answer: false,
    codes: [0x4006, 0x4030, 0x4031, 0xc0b2, 0xc201, [0xcfb0, 0xcfb5], 0xcfbf],
  },
  {
    name: 'FTP client',
    text: [
      'Completion status of the FTP client instructions SP.FTPPUT and SP.FTPGET.',
      'FTPクライアントのSP.FTPPUT命令、SP.FTPGET命令の完了ステータスに入ります。',
      'FTP客户端的SP.FTPPUT指令、SP.FTPGET指令的完成状态。',
      'FTP用戶端的SP.FTPPUT指令、SP.FTPGET指令的完成狀態。',
    ],
    answer: false,
    codes: [
      0x41c5,
      0x41c7,
      [0x41cc, 0x41cf],
      0x41d8,
      0x41df,
      0x41e4,
      0x41eb,
      0x41fe,
      0x4c40,
      0x4c43,
      0x4c44,
      0xc035,
      0xc616,
      0xc618,
      0xc619,
      [0xc620, 0xc622],
    ],
  },
  {
    name: 'Ethernet connection',
    text: [
      'Error code of an Ethernet connection: SD10130 to SD10137; on an Ethernet module Un\\G108 to Un\\G139, diagnostics and history.',
      'Ethernetのコネクションごとのエラーコードです: SD10130～SD10137(EthernetユニットではUn\\G108～Un\\G139、診断、履歴)。',
      '以太网各连接的错误代码：SD10130～SD10137（以太网模块为Un\\G108～Un\\G139、诊断、履历）。',
      '乙太網路各連線的錯誤代碼：SD10130～SD10137（乙太網路模組為Un\\G108～Un\\G139、診斷、履歷）。',
    ],
    answer: false,
    codes: [
      0x1120,
      0x1134,
      0x2160,
      [0x7305, 0x7308],
      0x7311,
      0xc012,
      0xc013,
      0xc015,
      0xc017,
      0xc035,
      [0xc050, 0xc054],
      [0xc056, 0xc059],
      0xc05b,
      0xc05c,
      [0xc05e, 0xc061],
      0xc06f,
      0xc0b2,
      0xc0d8,
      0xc1a2,
      0xc1a4,
      0xc1a7,
      0xc1a8,
      0xc614,
      0xc709,
      0xcfb2,
      ...socket,
      ...dedicatedInstruction,
      ...predefinedProtocol,
      ...iqss,
    ],
  },
  {
    name: 'Ethernet module',
    text: [
      'Error code of an FX5 Ethernet module: latest error code (Un\\G29), module diagnostics, event history.',
      'FX5 Ethernetユニットのエラーコードです: 最新エラーコード(Un\\G29)、ユニット診断、イベント履歴。',
      'FX5以太网模块的错误代码：最新错误代码（Un\\G29）、模块诊断、事件履历。',
      'FX5乙太網路模組的錯誤代碼：最新錯誤代碼（Un\\G29）、模組診斷、事件履歷。',
    ],
    answer: false,
    codes: [
      0x0800,
      0x0904,
      [0x0910, 0x0913],
      0x1080,
      [0x1810, 0x1812],
      0x1852,
      0x1861,
      [0x1870, 0x1877],
      [0x1900, 0x1904],
      0x1d80,
      [0x1d83, 0x1d85],
      0x1dc4,
      [0x1e10, 0x1e14],
      0x1f00,
      0x2160,
      [0x2c80, 0x2c82],
      0x2cf0,
      [0x2da0, 0x2dab],
      0x2db0,
      0x3030,
      [0x3040, 0x3042],
      0x3056,
      [0x3060, 0x3068],
      [0x306a, 0x306f],
      0x3073,
      0x3074,
      0x3082,
      [0x3085, 0x3089],
      [0x3094, 0x309f],
      [0x30a8, 0x30aa],
      0x3cf1,
      [0x3e30, 0x3e42],
      [0x3e50, 0x3e56],
      [0x3e60, 0x3e63],
      0x3f92,
      0x3fa1,
      [0x4030, 0x4033],
      0x4041,
      0x4043,
      [0x480c, 0x480e],
    ],
  },
]

/** Every place a code is seen in; none for a code no list holds. */
export function placesOf(family: MelsecEndCodeFamily, code: number): readonly EndCodePlace[] {
  const ofFamily = endCodePlaces.filter((place) => (place.family ?? 'slmp') === family)
  return ofFamily.filter(({ codes }) =>
    codes.some((entry) => (typeof entry === 'number' ? entry === code : entry[0] <= code && code <= entry[1])),
  )
}
