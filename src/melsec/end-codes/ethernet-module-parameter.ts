// Parameter errors of FX5 Ethernet modules: which parameter it is says the event list (manual section 48).
import { type EndCodeEntry, FX5_EVENTS, filled } from './entry'
import type { RemedyName } from './remedies'
import type { Texts } from './texts'

/** A parameter, one code after the other; `{}` of the group's pattern stands for it. */
type Parameter = readonly [code: number, ...name: Texts]

interface ParameterGroup {
  readonly pattern: Texts
  readonly remedy: RemedyName
  readonly parameters: readonly Parameter[]
}

const groups: readonly ParameterGroup[] = [
  {
    pattern: [
      'External device configuration: the {} is wrong.',
      '相手機器接続構成設定: {}に異常があります。',
      '对象设备连接配置设置：{}异常。',
      '對象裝置連接配置設定：{}異常。',
    ],
    remedy: 'checkParameters',
    parameters: [
      [0x2da0, 'number of connections', 'コネクション設定数', '连接设置数', '連線設定數'],
      [0x2da1, 'connection No.', 'コネクションNo.', '连接编号', '連線編號'],
      [0x2da2, 'communication method', '通信手段', '通信手段', '通訊方式'],
      [0x2da3, 'protocol', 'プロトコル', '协议', '協定'],
      [0x2da4, 'open method', 'オープン方式', '打开方式', '開啟方式'],
      [
        0x2da5,
        'send/receive setting of the fixed buffer',
        '固定バッファ送受信設定',
        '固定缓冲收发设置',
        '固定緩衝收發設定',
      ],
      [0x2da6, 'IP address (IPv4)', 'IPアドレス(IPv4)', 'IP地址（IPv4）', 'IP位址（IPv4）'],
      [0x2da7, 'IP address (IPv6)', 'IPアドレス(IPv6)', 'IP地址（IPv6）', 'IP位址（IPv6）'],
      [0x2da8, 'existence confirmation', '生存確認', '生存确认', '存在確認'],
      [0x2da9, 'communication data code', '交信データコード', '通信数据代码', '通訊資料代碼'],
      [0x2daa, 'online change setting', 'RUN中書込み設定', 'RUN中写入设置', 'RUN中寫入設定'],
      [0x2dab, 'port number of the own node', '自ノードポート番号', '自节点端口号', '自節點連接埠號'],
    ],
  },
  {
    pattern: [
      'Configuration setting parameter: the {} is out of range.',
      '構成設定パラメータ: {}が範囲外です。',
      '配置设置参数：{}超出范围。',
      '配置設定參數：{}超出範圍。',
    ],
    remedy: 'supplier',
    parameters: [
      [0x3060, 'total number of connected devices', '総接続台数', '总连接台数', '總連接台數'],
      [0x3061, 'station No.', '局番', '站号', '站號'],
      [0x3062, 'number of occupied stations', '占有局数', '占用站数', '佔用站數'],
      [0x3063, 'reserved station', '予約局指定', '保留站指定', '保留站指定'],
      [0x3064, 'IP address format', 'IPアドレス形式', 'IP地址格式', 'IP位址格式'],
      [0x3065, 'group No.', 'グループNo.', '组No.', '群組No.'],
      [0x3066, 'IP address', 'IPアドレス', 'IP地址', 'IP位址'],
      [0x30a8, 'total number of occupied stations', '総占有局数', '总占用站数', '總佔用站數'],
    ],
  },
  {
    pattern: [
      'Group setting parameter: the {} is out of range.',
      'グループ設定パラメータ: {}が範囲外です。',
      '组设置参数：{}超出范围。',
      '群組設定參數：{}超出範圍。',
    ],
    remedy: 'supplier',
    parameters: [
      [0x3067, 'total number of groups', '総グループ数', '总组数', '總群組數'],
      [0x3068, 'group No.', 'グループNo.', '组No.', '群組No.'],
      [0x306a, 'constant link scan', 'コンスタントリンクスキャン設定', '恒定链接扫描设置', '恆定連結掃描設定'],
      [
        0x306b,
        'time-out of the disconnection detection',
        '切断検出のタイムアウト時間',
        '切断检测的超时时间',
        '切斷偵測的逾時時間',
      ],
      [
        0x306c,
        'number of time-outs of the disconnection detection',
        '切断検出の連続タイムアウト回数',
        '切断检测的连续超时次数',
        '切斷偵測的連續逾時次數',
      ],
    ],
  },
  {
    pattern: [
      'IP address setting parameter: the {} is out of range.',
      'IPアドレス設定パラメータ: {}が範囲外です。',
      'IP地址设置参数：{}超出范围。',
      'IP位址設定參數：{}超出範圍。',
    ],
    remedy: 'supplier',
    parameters: [
      [0x306d, 'IP address format', 'IPアドレス形式', 'IP地址格式', 'IP位址格式'],
      [0x306e, 'IP address (IPv4)', 'IPアドレス(IPv4)', 'IP地址（IPv4）', 'IP位址（IPv4）'],
      [0x306f, 'subnet mask', 'サブネットマスク', '子网掩码', '子網路遮罩'],
    ],
  },
  {
    pattern: [
      'Gateway address setting parameter: the {} is out of range.',
      'ゲートウェイアドレス設定パラメータ: {}が範囲外です。',
      '网关地址设置参数：{}超出范围。',
      '閘道位址設定參數：{}超出範圍。',
    ],
    remedy: 'supplier',
    parameters: [
      [0x3073, 'gateway address (IPv4)', 'ゲートウェイアドレス(IPv4)', '网关地址（IPv4）', '閘道位址（IPv4）'],
      [0x3074, 'subnet mask', 'サブネットマスク', '子网掩码', '子網路遮罩'],
      [0x309f, 'gateway address (IPv6)', 'ゲートウェイアドレス(IPv6)', '网关地址（IPv6）', '閘道位址（IPv6）'],
    ],
  },
  {
    pattern: [
      'Data communication timer parameter: the {} is out of range.',
      'データ通信タイマ設定パラメータ: {}が範囲外です。',
      '数据通信定时器设置参数：{}超出范围。',
      '資料通訊計時器設定參數：{}超出範圍。',
    ],
    remedy: 'supplier',
    parameters: [
      [0x3082, 'timer change', 'タイマ変更指定', '定时器变更指定', '計時器變更指定'],
      [
        0x3085,
        'start interval of the existence confirmation',
        '生存確認開始間隔タイマ',
        '生存确认开始间隔定时器',
        '存在確認開始間隔計時器',
      ],
      [
        0x3086,
        'unit of the start interval',
        '開始間隔タイマの単位指定',
        '开始间隔定时器的单位指定',
        '開始間隔計時器的單位指定',
      ],
      [
        0x3087,
        'interval of the existence confirmation',
        '生存確認間隔タイマ',
        '生存确认间隔定时器',
        '存在確認間隔計時器',
      ],
      [0x3088, 'unit of the interval', '間隔タイマの単位指定', '间隔定时器的单位指定', '間隔計時器的單位指定'],
      [
        0x3089,
        'number of resends of the existence confirmation',
        '生存確認の再送回数',
        '生存确认的重发次数',
        '存在確認的重送次數',
      ],
      [0x3094, 'number of retries', 'リトライ回数', '重试次数', '重試次數'],
    ],
  },
  {
    pattern: [
      'IP filter: the {} is out of range.',
      'IPフィルタ設定: {}が範囲外です。',
      'IP筛选设置：{}超出范围。',
      'IP篩選設定：{}超出範圍。',
    ],
    remedy: 'supplier',
    parameters: [
      [0x3095, 'target IP address setting', '対象IPアドレス設定', '对象IP地址设置', '對象IP位址設定'],
      [0x3096, 'first target IP address', '先頭の対象IPアドレス', '开始对象IP地址', '起始對象IP位址'],
      [0x3097, 'last target IP address', '最終の対象IPアドレス', '结束对象IP地址', '結束對象IP位址'],
      [
        0x3099,
        'number of settings of excluded IP addresses',
        '除外IPアドレス設定の件数',
        '除外IP地址设置的件数',
        '除外IP位址設定的件數',
      ],
      [
        0x309a,
        'No. of the target IP address setting',
        '対象IPアドレス設定No.',
        '对象IP地址设置No.',
        '對象IP位址設定No.',
      ],
      [0x309b, 'number of excluded IP addresses', '除外IPアドレスの件数', '除外IP地址的件数', '除外IP位址的件數'],
      [0x309c, 'excluded IP address', '除外IPアドレス', '除外IP地址', '除外IP位址'],
    ],
  },
  {
    pattern: ['The {} is out of range.', '{}が範囲外です。', '{}超出范围。', '{}超出範圍。'],
    remedy: 'supplier',
    parameters: [
      [0x30aa, 'simple CPU communication parameter', 'シンプルCPU通信パラメータ', '简单CPU通信参数', '簡單CPU通訊參數'],
    ],
  },
]

const entries: readonly EndCodeEntry[] = [
  {
    code: 0x2c80,
    to: 0x2c82,
    meaning: [
      'The external device configuration has a parameter error.',
      '相手機器接続構成設定のパラメータに異常を検出しました。',
      '在对象设备连接配置设置中检测出参数异常。',
      '在對象裝置連接配置設定中檢測出參數異常。',
    ],
    remedy: [
      'Correct the external device configuration in GX Works3; its connections and the settings of simple CPU communication may be 32 together. If the error comes back, contact the supplier.',
      'GX Works3で相手機器接続構成設定を修正し、コネクション数とシンプルCPU通信の設定数の合計を32以下にしてください。再発する場合は購入先にご相談ください。',
      '请在GX Works3中修改对象设备连接配置设置，并使连接数与简单CPU通信设置数合计在32以下。如再次发生，请联系供应商。',
      '請在GX Works3中修改對象裝置連接配置設定，並使連線數與簡單CPU通訊設定數合計在32以下。如再次發生，請聯絡供應商。',
    ],
    source: FX5_EVENTS,
  },
  {
    code: 0x2db0,
    meaning: [
      'The requested or set data are wrong.',
      '要求データまたは設定データに異常があります。',
      '请求数据或设置数据异常。',
      '請求資料或設定資料異常。',
    ],
    remedy: 'correctRequest',
    source: FX5_EVENTS,
  },
  {
    code: 0x3098,
    meaning: [
      'IP filter: the first target IP address is not below the last.',
      'IPフィルタ設定: 先頭の対象IPアドレスが最終の対象IPアドレス以上です。',
      'IP筛选设置：开始对象IP地址不小于结束对象IP地址。',
      'IP篩選設定：起始對象IP位址不小於結束對象IP位址。',
    ],
    remedy: 'supplier',
    source: FX5_EVENTS,
  },
  {
    code: 0x309d,
    meaning: [
      'IP address setting parameter: the target module does not support it.',
      'IPアドレス設定パラメータ: 対象ユニットが対応していません。',
      'IP地址设置参数：对象模块不支持。',
      'IP位址設定參數：對象模組不支援。',
    ],
    remedy: 'supplier',
    source: FX5_EVENTS,
  },
  {
    code: 0x309e,
    meaning: [
      'Gateway address setting parameter: the target module does not support it.',
      'ゲートウェイアドレス設定パラメータ: 対象ユニットが対応していません。',
      '网关地址设置参数：对象模块不支持。',
      '閘道位址設定參數：對象模組不支援。',
    ],
    remedy: 'supplier',
    source: FX5_EVENTS,
  },
  {
    code: 0x30a9,
    meaning: [
      'Configuration setting parameter: master and slave station have the same IP address.',
      '構成設定パラメータ: マスタ局とスレーブ局のIPアドレスが同じです。',
      '配置设置参数：主站与从站的IP地址一致。',
      '配置設定參數：主站與從站的IP位址相同。',
    ],
    remedy: 'supplier',
    source: FX5_EVENTS,
  },
]

export const ethernetModuleParameterEndCodes: readonly EndCodeEntry[] = [
  ...groups.flatMap(({ pattern, remedy, parameters }) =>
    parameters.map(
      ([code, ...name]): EndCodeEntry => ({ code, meaning: filled(pattern, name), remedy, source: FX5_EVENTS }),
    ),
  ),
  ...entries,
]
