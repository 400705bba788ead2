// Operation errors (SD0/SD8067) of communication instructions and parameters of an FX5 CPU module, and the IP address
// change.
import { type EndCodeEntry, FX5_ETHERNET, FX5_MODBUS, FX5_SERIAL } from './entry'

const instructions = `${FX5_SERIAL} and 47.3`

export const operationEndCodes: readonly EndCodeEntry[] = [
  {
    code: 0x0000,
    meaning: ['No error.', 'エラーはありません。', '没有异常。', '沒有異常。'],
    remedy: 'nothing',
    source: FX5_SERIAL,
  },
  {
    code: 0x1810,
    meaning: [
      'RS2 or ADPRW instruction: the channel is used by another instruction. On an FX5 Ethernet module: the IP address change failed.',
      'RS2命令、ADPRW命令: 指定チャンネルは他の命令で使用中です。FX5 Ethernetユニットでは: IPアドレスの変更に失敗しました。',
      'RS2指令、ADPRW指令：指定的通道正被其他指令使用。FX5以太网模块：IP地址更改失败。',
      'RS2指令、ADPRW指令：指定的通道正被其他指令使用。FX5乙太網路模組：IP位址變更失敗。',
    ],
    remedy: [
      'Run only one instruction per channel at a time. On an Ethernet module, change the IP address again.',
      '1つのチャンネルで同時に実行する命令を1つにしてください。EthernetユニットではIPアドレス変更を再度実行してください。',
      '请在一个通道中同时只执行一个指令。以太网模块请重新执行IP地址更改。',
      '請在一個通道中同時只執行一個指令。乙太網路模組請重新執行IP位址變更。',
    ],
    source: `${FX5_MODBUS}, 47.1 and 47.2`,
  },
  {
    code: 0x1920,
    meaning: [
      'IP address change: a set value is out of range.',
      'IPアドレス変更: IPアドレス設定の値が設定範囲外です。',
      'IP地址更改：IP地址设置的值超出设置范围。',
      'IP位址變更：IP位址設定的值超出設定範圍。',
    ],
    remedy: [
      'Correct SD8492 to SD8497; on an Ethernet module Un\\G50 to Un\\G55.',
      'SD8492～SD8497(EthernetユニットではUn\\G50～Un\\G55)の値を修正してください。',
      '请修改SD8492～SD8497（以太网模块为Un\\G50～Un\\G55）的值。',
      '請修改SD8492～SD8497（乙太網路模組為Un\\G50～Un\\G55）的值。',
    ],
    source: FX5_ETHERNET,
  },
  {
    code: 0x1921,
    meaning: [
      'IP address change: the write request and the clear request turned on together.',
      'IPアドレス変更: 書込み要求とクリア要求が同時にONしました。',
      'IP地址更改：写入请求与清除请求同时ON。',
      'IP位址變更：寫入請求與清除請求同時ON。',
    ],
    remedy: [
      'Turn on only one of SM8492 and SM8495; on an Ethernet module of Un\\G56 and Un\\G58.',
      'SM8492とSM8495(EthernetユニットではUn\\G56とUn\\G58)を同時にONしないでください。',
      '请勿将SM8492与SM8495（以太网模块为Un\\G56与Un\\G58）同时置ON。',
      '請勿將SM8492與SM8495（乙太網路模組為Un\\G56與Un\\G58）同時置ON。',
    ],
    source: FX5_ETHERNET,
  },
  {
    code: 0x2220,
    meaning: [
      'The parameters were not found, or are damaged.',
      'パラメータがないか、内容が破損しています。',
      '未检测到参数，或参数内容已损坏。',
      '未偵測到參數，或參數內容已損壞。',
    ],
    remedy: 'writeProject',
    source: FX5_SERIAL,
  },
  {
    code: 0x2221,
    meaning: [
      'A parameter is wrong or out of range.',
      'パラメータに異常があるか、設定値が使用可能な範囲を超えています。',
      '参数异常，或设定值超出可使用的范围。',
      '參數異常，或設定值超出可使用的範圍。',
    ],
    remedy: 'writeProject',
    source: FX5_SERIAL,
  },
  {
    code: 0x2222,
    meaning: [
      'A parameter is out of range.',
      'パラメータの設定値が使用可能な範囲を超えています。',
      '参数设定值超出可使用的范围。',
      '參數設定值超出可使用的範圍。',
    ],
    remedy: 'writeProject',
    source: FX5_SERIAL,
  },
  {
    code: 0x2820,
    meaning: [
      'An operand of the instruction goes beyond the range of its device or label.',
      '命令のオペランドが、デバイスまたはラベルの使用範囲を超えています。',
      '指令的操作数超出软元件或标签的使用范围。',
      '指令的運算元超出軟元件或標籤的使用範圍。',
    ],
    remedy: 'program',
    source: instructions,
  },
  {
    code: 0x2822,
    meaning: [
      'The instruction cannot be used with this device.',
      '命令に指定できないデバイスです。',
      '指定了该指令不能指定的软元件。',
      '指定了該指令不能指定的軟元件。',
    ],
    remedy: 'program',
    source: instructions,
  },
  {
    code: 0x3100,
    meaning: [
      'The program holds an instruction that cannot be used or decoded.',
      'プログラムに使用できない命令、または解読できない命令が含まれています。',
      '程序中包含无法使用或无法解读的指令。',
      '程式中包含無法使用或無法解讀的指令。',
    ],
    remedy: [
      'Correct the step that the module diagnostics of GX Works3 show, or write the program again; take measures against noise.',
      'GX Works3のユニット診断が示すステップを修正するか、プログラムを再度書き込み、ノイズ対策を行ってください。',
      '请修改GX Works3模块诊断所示的步，或重新写入程序，并采取抗干扰措施。',
      '請修改GX Works3模組診斷所示的步，或重新寫入程式，並採取抗干擾措施。',
    ],
    source: FX5_SERIAL,
  },
  {
    code: 0x3405,
    meaning: [
      'A value given to the instruction is out of range.',
      '命令に指定したデータが、指定できる範囲を超えています。',
      '输入到指令的数据超出可指定的范围。',
      '輸入到指令的資料超出可指定的範圍。',
    ],
    remedy: 'program',
    source: instructions,
  },
  {
    code: 0x3582,
    meaning: [
      'The instruction cannot be used in an interrupt program.',
      '割込みプログラムで使用できない命令です。',
      '使用了中断程序中不能使用的指令。',
      '使用了中斷程式中不能使用的指令。',
    ],
    remedy: 'program',
    source: FX5_SERIAL,
  },
  {
    code: 0x3600,
    meaning: [
      'The function is not set in the parameters of the channel, or ADPRW ran in a MODBUS slave.',
      '指定チャンネルのパラメータに機能が設定されていないか、MODBUSスレーブでADPRW命令を実行しました。',
      '指定通道的参数中未设置该功能，或在MODBUS从站中执行了ADPRW指令。',
      '指定通道的參數中未設定該功能，或在MODBUS從站中執行了ADPRW指令。',
    ],
    remedy: 'writeProject',
    source: instructions,
  },
]
