// What a code most likely means when a certain command got it.
import { BACKGROUND, type EndCodeHint } from './entry'

const measured = 'measured by others'

export const endCodeHints: readonly EndCodeHint[] = [
  {
    code: 0xc059,
    commands: ['entryMonitorDevice', 'executeMonitor'],
    cause: [
      'iQ-F CPU modules have no monitor registration: read the same devices with Read Random.',
      'iQ-F CPUにはモニタ登録がありません。同じデバイスをランダム読出しで読み出してください。',
      'iQ-F CPU没有监视登录：请用随机读取读取相同的软元件。',
      'iQ-F CPU沒有監視登錄：請用隨機讀取讀取相同的軟元件。',
    ],
    source: measured,
  },
  {
    code: 0xc059,
    commands: ['readBlock', 'writeBlock', 'readTypeName'],
    cause: [
      'The built-in Ethernet ports of Q and L CPUs do not have this command; Ethernet modules (E71) do.',
      'Q/L CPUの内蔵Ethernetポートはこのコマンドに対応していません。Ethernetユニット(E71)は対応しています。',
      'Q/L CPU的内置以太网端口不支持该指令，以太网模块（E71）支持。',
      'Q/L CPU的內建乙太網路連接埠不支援該指令，乙太網路模組（E71）支援。',
    ],
    source: measured,
  },
  {
    code: 0xc05b,
    commands: ['writeBlock', 'readBlock'],
    cause: [
      'Some CPUs refuse word blocks and bit blocks in one request: send them in two.',
      'ワードブロックとビットブロックの混在を受け付けないCPUがあります。2回に分けて要求してください。',
      '有的CPU不接受字块和位块混合在同一请求中：请分两次请求。',
      '有的CPU不接受字區塊和位元區塊混合在同一請求中：請分兩次請求。',
    ],
    source: measured,
  },
  {
    code: 0x4030,
    commands: ['writeBits', 'writeWords', 'writeRandomBits', 'writeRandomWords', 'writeBlock'],
    cause: [
      'iQ-R CPUs refuse to write step relays (S) and, in this way, contacts and coils of long timers.',
      'iQ-R CPUではステップリレー(S)や、ロングタイマの接点/コイルへのこの方法での書込みはできません。',
      'iQ-R CPU不允许写入步进继电器（S），也不允许以此方式写入长定时器的触点/线圈。',
      'iQ-R CPU不允許寫入步進繼電器（S），也不允許以此方式寫入長計時器的接點/線圈。',
    ],
    source: measured,
  },
  {
    code: 0x4013,
    commands: ['remoteLatchClear', 'remoteReset'],
    cause: [
      'The CPU must be in STOP before a latch clear or a reset.',
      'ラッチクリアやリセットの前にCPUをSTOPにする必要があります。',
      '锁存清除或复位之前，CPU必须处于STOP。',
      '鎖存清除或重置之前，CPU必須處於STOP。',
    ],
    source: 'SLMP reference manual 5.6',
  },
  {
    code: 0x408b,
    commands: ['remoteReset'],
    cause: [
      'Remote reset is not enabled in the CPU parameter.',
      'CPUパラメータでリモートリセットが許可されていません。',
      'CPU参数中未允许远程复位。',
      'CPU參數中未允許遠端重置。',
    ],
    source: BACKGROUND,
  },
  {
    code: 0x408b,
    commands: ['remoteRun', 'remotePause', 'remoteLatchClear'],
    cause: [
      'Another device put the CPU into STOP or PAUSE; release it there, or force RUN or PAUSE.',
      '他の機器がリモートSTOP/PAUSEを実行中です。その機器から解除するか、強制実行してください。',
      '其他设备执行了远程STOP/PAUSE：请由该设备解除，或强制执行。',
      '其他裝置執行了遠端STOP/PAUSE：請由該裝置解除，或強制執行。',
    ],
    source: 'SLMP reference manual 5.6',
  },
]
