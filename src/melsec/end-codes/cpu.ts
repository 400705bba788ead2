// Errors the CPU module detects in a request, except those about files and memories (cpu-file.ts) and routes
// (cpu-route.ts).
import { BACKGROUND, type EndCodeEntry, FX5_ETHERNET } from './entry'

export const cpuEndCodes: readonly EndCodeEntry[] = [
  {
    code: 0x4000,
    meaning: [
      'Sum check error between the CPU and its partner.',
      'CPUとの通信でサムチェックエラーが発生しました。',
      '与CPU的通信中发生和校验错误。',
      '與CPU的通訊中發生總和檢查錯誤。',
    ],
    remedy: 'serialLine',
    source: BACKGROUND,
  },
  {
    code: 0x4001,
    meaning: [
      'The CPU does not support the request.',
      'CPUが対応していない要求です。',
      'CPU不支持该请求。',
      'CPU不支援該請求。',
    ],
    remedy: 'otherCommand',
    source: BACKGROUND,
  },
  {
    code: 0x4002,
    meaning: [
      'The CPU does not support the request.',
      'CPUが対応していない要求です。',
      'CPU不支持该请求。',
      'CPU不支援該請求。',
    ],
    remedy: 'otherCommand',
    source: BACKGROUND,
  },
  {
    code: 0x4003,
    meaning: [
      'The command cannot be sent to all stations at once.',
      '全局指定(グローバル要求)では実行できないコマンドです。',
      '该指令不能以全站指定（全局请求）执行。',
      '該指令不能以全站指定（全域請求）執行。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
  {
    code: 0x4004,
    meaning: [
      'The CPU refuses every operation: system protection is on, or it is still starting.',
      'システムプロテクト中または起動処理中のため、CPUへの操作ができません。',
      '系统保护中或启动处理中，无法对CPU进行操作。',
      '系統保護中或啟動處理中，無法對CPU進行操作。',
    ],
    remedy: [
      'Release the system protection of the CPU; after power-on or reset wait until it has started.',
      'CPUのシステムプロテクトを解除するか、電源ON/リセット後は起動完了を待ってください。',
      '请解除CPU的系统保护；上电或复位后请等待启动完成。',
      '請解除CPU的系統保護；上電或重置後請等待啟動完成。',
    ],
    source: BACKGROUND,
  },
  {
    code: 0x4005,
    meaning: [
      'The request or its answer is too large.',
      '要求のデータ量が多すぎます。',
      '请求的数据量过大。',
      '請求的資料量過大。',
    ],
    remedy: 'lessPoints',
    source: BACKGROUND,
  },
  {
    code: 0x4006,
    meaning: [
      'The start of the communication failed.',
      'イニシャル交信に失敗しました。',
      '初始通信失败。',
      '初始通訊失敗。',
    ],
    remedy: [
      'Let the stations start communication at different times.',
      '通信を開始するタイミングを局ごとにずらしてください。',
      '请错开各站开始通信的时机。',
      '請錯開各站開始通訊的時機。',
    ],
    source: FX5_ETHERNET,
  },
  {
    code: 0x4008,
    meaning: [
      'The CPU is busy: its buffer is full.',
      'CPUがBUSYです(バッファに空きがありません)。',
      'CPU忙（缓冲区没有空闲）。',
      'CPU忙碌（緩衝區沒有空閒）。',
    ],
    remedy: 'lessLoad',
    source: BACKGROUND,
  },
  {
    code: 0x4010,
    meaning: [
      'Not possible while the CPU is in RUN.',
      'CPUがRUN中のため実行できません。',
      'CPU处于RUN中，无法执行。',
      'CPU處於RUN中，無法執行。',
    ],
    remedy: 'stopCpu',
    source: BACKGROUND,
  },
  {
    code: 0x4013,
    meaning: [
      'Possible only while the CPU is in STOP.',
      'CPUがSTOP状態でないため実行できません。',
      'CPU不处于STOP状态，无法执行。',
      'CPU不處於STOP狀態，無法執行。',
    ],
    remedy: 'stopCpu',
    source: BACKGROUND,
  },
  {
    code: 0x4030,
    meaning: [
      'This CPU cannot handle the device name, or not with this command.',
      '指定されたデバイス名は扱えません。',
      '无法处理指定的软元件名。',
      '無法處理指定的軟元件名稱。',
    ],
    remedy: 'correctDevice',
    source: FX5_ETHERNET,
  },
  {
    code: 0x4031,
    meaning: [
      'The device number is out of range, or the device is not supported by the target.',
      '指定されたデバイス番号が範囲外か、対象CPUで扱えないデバイスです。',
      '指定的软元件编号超出范围，或对象CPU无法处理该软元件。',
      '指定的軟元件編號超出範圍，或對象CPU無法處理該軟元件。',
    ],
    remedy: 'correctDevice',
    source: FX5_ETHERNET,
  },
  {
    code: 0x4032,
    meaning: [
      'The device cannot be used with random access or monitoring (TS, TC, STS, STC, CS, CC), or is modified wrongly.',
      'ランダム読出し/書込みやモニタで使用できないデバイス(TS、TC、STS、STC、CS、CC)、または修飾に誤りがあります。',
      '该软元件不能用于随机读写或监视（TS、TC、STS、STC、CS、CC），或修饰有误。',
      '該軟元件不能用於隨機讀寫或監視（TS、TC、STS、STC、CS、CC），或修飾有誤。',
    ],
    remedy: [
      'Read or write it in bit units, and check the modification (index, digits).',
      'ビット単位で読出し/書込みを行い、修飾(インデックス、桁指定)を確認してください。',
      '请以位为单位读写，并检查修饰（变址、位数指定）。',
      '請以位元為單位讀寫，並檢查修飾（變址、位數指定）。',
    ],
    source: FX5_ETHERNET,
  },
  {
    code: 0x4033,
    meaning: [
      'The device is used by the system and cannot be written.',
      'システムが使用するデバイスのため書き込めません。',
      '该软元件由系统使用，无法写入。',
      '該軟元件由系統使用，無法寫入。',
    ],
    remedy: [
      'Do not write it.',
      'このデバイスには書き込まないでください。',
      '请勿写入该软元件。',
      '請勿寫入該軟元件。',
    ],
    source: FX5_ETHERNET,
  },
  {
    code: 0x4034,
    meaning: [
      'The completion device of a dedicated instruction cannot be turned on, so the request is not carried out.',
      '専用命令の完了デバイスをONできないため、要求を実行できません。',
      '专用指令的完成软元件无法置ON，无法执行请求。',
      '專用指令的完成軟元件無法置ON，無法執行請求。',
    ],
    remedy: 'program',
    source: BACKGROUND,
  },
  {
    code: 0x4040,
    meaning: [
      'The module behind U\\G cannot do the request.',
      '指定されたインテリジェント機能ユニットでは実行できない要求です。',
      '指定的智能功能模块无法执行该请求。',
      '指定的智慧功能模組無法執行該請求。',
    ],
    remedy: 'correctRequest',
    source: BACKGROUND,
  },
  {
    code: 0x4041,
    meaning: [
      'The access goes beyond the buffer memory of the module.',
      'アクセス範囲がインテリジェント機能ユニットのバッファメモリ範囲を超えています。',
      '访问范围超出智能功能模块的缓冲存储器范围。',
      '存取範圍超出智慧功能模組的緩衝記憶體範圍。',
    ],
    remedy: [
      'Check the buffer memory address and the number of points.',
      'バッファメモリアドレスと点数を確認してください。',
      '请检查缓冲存储器地址和点数。',
      '請檢查緩衝記憶體位址和點數。',
    ],
    source: FX5_ETHERNET,
  },
  {
    code: 0x4042,
    meaning: [
      'The module behind U\\G cannot be accessed.',
      '指定されたインテリジェント機能ユニットにアクセスできません。',
      '无法访问指定的智能功能模块。',
      '無法存取指定的智慧功能模組。',
    ],
    remedy: [
      'Check that the module is mounted, runs, and has the start I/O number given.',
      'ユニットの装着、動作、先頭I/O番号を確認してください。',
      '请检查模块的安装、动作和起始I/O编号。',
      '請檢查模組的安裝、動作和起始I/O編號。',
    ],
    source: BACKGROUND,
  },
  {
    code: 0x4043,
    meaning: [
      'There is no module at the start I/O number, or no such network.',
      '指定された位置にインテリジェント機能ユニットまたはネットワークユニットがありません。',
      '指定位置没有智能功能模块或网络模块。',
      '指定位置沒有智慧功能模組或網路模組。',
    ],
    remedy: [
      'Correct the module number (start I/O number without its last digit) or the network number.',
      'ユニット番号(先頭I/O番号の下1桁を除いた値)またはネットワーク番号を修正してください。',
      '请修正模块编号（去掉末位的起始I/O编号）或网络号。',
      '請修正模組編號（去掉末位的起始I/O編號）或網路號。',
    ],
    source: `${FX5_ETHERNET}; without the network measured by others on L02S`,
  },
  {
    code: 0x4044,
    meaning: [
      'The control bus failed during the access to a module.',
      'ユニットへのアクセス中にコントロールバスエラーが発生しました。',
      '访问模块时发生控制总线错误。',
      '存取模組時發生控制匯流排錯誤。',
    ],
    remedy: 'hardware',
    source: BACKGROUND,
  },
  {
    code: 0x4060,
    meaning: [
      'Another device is using the same online function.',
      '同じオンライン機能を他の機器が使用しています。',
      '其他设备正在使用同一在线功能。',
      '其他裝置正在使用同一線上功能。',
    ],
    remedy: 'retryLater',
    source: BACKGROUND,
  },
  {
    code: 0x4068,
    meaning: [
      'Another device is carrying out the same operation.',
      '他の機器が同じ操作を実行中です。',
      '其他设备正在执行同一操作。',
      '其他裝置正在執行同一操作。',
    ],
    remedy: 'retryLater',
    source: BACKGROUND,
  },
  {
    code: 0x4080,
    meaning: [
      'The request data are wrong, or too many for one Write Random (Ethernet modules of Q and L).',
      '要求データに誤りがあるか、ランダム書込みの点数が多すぎます(Q/LのEthernetユニット)。',
      '请求数据有误，或随机写入的点数过多（Q/L的以太网模块）。',
      '請求資料有誤，或隨機寫入的點數過多（Q/L的乙太網路模組）。',
    ],
    remedy: 'lessPoints',
    source: `${BACKGROUND}; over the limit measured by others on Q12H and L02S with E71`,
  },
  {
    code: 0x4082,
    meaning: [
      'The command cannot run now: the same is still being carried out.',
      '同じ処理を実行中のため、コマンドを実行できません。',
      '同一处理正在执行，无法执行该指令。',
      '同一處理正在執行，無法執行該指令。',
    ],
    remedy: 'retryLater',
    source: BACKGROUND,
  },
  {
    code: 0x40c0,
    meaning: [
      'There is no such label, or it may not be accessed from outside.',
      '指定されたラベルがないか、外部機器からのアクセスが許可されていません。',
      '没有指定的标签，或不允许从外部设备访问。',
      '沒有指定的標籤，或不允許從外部裝置存取。',
    ],
    remedy: [
      'Check the name of the label, and tick "Access from External Device" in its row in GX Works3.',
      'ラベル名を確認し、GX Works3で「外部機器からのアクセス」を有効にしてください。',
      '请确认标签名，并在GX Works3中勾选“外部设备访问”。',
      '請確認標籤名稱，並在GX Works3中勾選「外部裝置存取」。',
    ],
    source: BACKGROUND,
  },
  {
    code: 0x408b,
    meaning: [
      'The remote request cannot be carried out: it is not permitted, or another device holds the CPU.',
      'リモート要求を実行できません(許可されていないか、他の機器がリモート操作中です)。',
      '无法执行远程请求（未被允许，或其他设备正在远程操作）。',
      '無法執行遠端請求（未被允許，或其他裝置正在遠端操作）。',
    ],
    remedy: [
      'Enable remote reset in the CPU parameter; release STOP or PAUSE from the device that set it, or force it.',
      'CPUパラメータでリモートリセットを許可し、STOP/PAUSEを行った機器から解除するか、強制実行してください。',
      '请在CPU参数中允许远程复位；由执行STOP/PAUSE的设备解除，或强制执行。',
      '請在CPU參數中允許遠端重置；由執行STOP/PAUSE的裝置解除，或強制執行。',
    ],
    source: BACKGROUND,
  },
  {
    code: 0x4100,
    meaning: ['The CPU found a hardware fault.', 'CPUのハードウェア異常です。', 'CPU硬件异常。', 'CPU硬體異常。'],
    remedy: 'hardware',
    source: BACKGROUND,
  },
]
