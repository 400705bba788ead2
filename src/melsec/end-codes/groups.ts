// Which module a code comes from, for codes without a text. The numbers are shared out between the module families.
import type { EndCodeGroup } from './entry'

const source =
  'background: error code ranges by place of detection, QCPU user manual (hardware design, maintenance and inspection)'

export const endCodeGroups: readonly EndCodeGroup[] = [
  {
    from: 0x4000,
    to: 0x4fff,
    meaning: [
      'The CPU module detected an error.',
      'CPUユニットが検出したエラーです。',
      'CPU模块检测出的错误。',
      'CPU模組檢測出的錯誤。',
    ],
    remedy: 'manual',
    source,
  },
  {
    from: 0x7000,
    to: 0x7fff,
    meaning: [
      'A serial communication module or intelligent function module detected an error.',
      'シリアルコミュニケーションユニットまたはインテリジェント機能ユニットが検出したエラーです。',
      '串行通信模块或智能功能模块检测出的错误。',
      '序列通訊模組或智慧功能模組檢測出的錯誤。',
    ],
    remedy: 'manual',
    source,
  },
  {
    from: 0xb000,
    to: 0xbfff,
    meaning: [
      'A CC-Link module detected an error.',
      'CC-Linkユニットが検出したエラーです。',
      'CC-Link模块检测出的错误。',
      'CC-Link模組檢測出的錯誤。',
    ],
    remedy: 'manual',
    source,
  },
  {
    from: 0xc000,
    to: 0xcfff,
    meaning: [
      'An Ethernet module or built-in Ethernet port detected an error.',
      'Ethernetユニットまたは内蔵Ethernetポートが検出したエラーです。',
      '以太网模块或内置以太网端口检测出的错误。',
      '乙太網路模組或內建乙太網路連接埠檢測出的錯誤。',
    ],
    remedy: 'manual',
    source,
  },
  {
    from: 0xd000,
    to: 0xdfff,
    meaning: [
      'A CC-Link IE Field Network module detected an error.',
      'CC-Link IEフィールドネットワークユニットが検出したエラーです。',
      'CC-Link IE现场网络模块检测出的错误。',
      'CC-Link IE現場網路模組檢測出的錯誤。',
    ],
    remedy: 'manual',
    source,
  },
  {
    from: 0xe000,
    to: 0xefff,
    meaning: [
      'A CC-Link IE Controller Network module detected an error.',
      'CC-Link IEコントローラネットワークユニットが検出したエラーです。',
      'CC-Link IE控制网络模块检测出的错误。',
      'CC-Link IE控制網路模組檢測出的錯誤。',
    ],
    remedy: 'manual',
    source,
  },
  {
    from: 0xf000,
    to: 0xffff,
    meaning: [
      'A MELSECNET/H module detected an error.',
      'MELSECNET/Hユニットが検出したエラーです。',
      'MELSECNET/H模块检测出的错误。',
      'MELSECNET/H模組檢測出的錯誤。',
    ],
    remedy: 'manual',
    source,
  },
]
