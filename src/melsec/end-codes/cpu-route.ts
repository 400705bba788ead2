// 4A00H and up: errors the CPU module detects on the way to another station or module.
import { BACKGROUND, type EndCodeEntry } from './entry'

export const cpuRouteEndCodes: readonly EndCodeEntry[] = [
  {
    code: 0x4a00,
    meaning: [
      'The target network cannot be reached: no routing parameter leads there.',
      'ルーチングパラメータが設定されていないため、指定局にアクセスできません。',
      '未设置路由参数，无法访问指定站。',
      '未設定路由參數，無法存取指定站。',
    ],
    remedy: [
      'Set the routing parameters of the request source and the relay stations, and check the route.',
      '要求元と中継局にルーチングパラメータを設定し、ルートを確認してください。',
      '请设置请求源和中继站的路由参数，并检查路径。',
      '請設定請求源和中繼站的路由參數，並檢查路徑。',
    ],
    source: BACKGROUND,
  },
  {
    code: 0x4a01,
    meaning: [
      'The network of the routing parameter does not exist.',
      'ルーチングパラメータで指定したネットワークが存在しません。',
      '路由参数中指定的网络不存在。',
      '路由參數中指定的網路不存在。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
  {
    code: 0x4a02,
    meaning: [
      'The station cannot be accessed.',
      '指定局にアクセスできません。',
      '无法访问指定站。',
      '無法存取指定站。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
  {
    code: 0x4b00,
    meaning: [
      'An error occurred at the target or a relay station, or the module I/O No. is wrong.',
      'アクセス先または中継局で異常が発生したか、要求先ユニットI/O番号に誤りがあります。',
      '访问目标或中继站发生异常，或请求目标模块I/O编号有误。',
      '存取目標或中繼站發生異常，或請求目標模組I/O編號有誤。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
  {
    code: 0x4b02,
    meaning: [
      'The request is addressed to a module that is no CPU.',
      'CPUユニット以外に対する要求です。',
      '请求的对象不是CPU模块。',
      '請求的對象不是CPU模組。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
  {
    code: 0x4b03,
    meaning: [
      'The route is not supported: a module on the way cannot pass the request on.',
      '対応していないルートが指定されました。',
      '指定了不支持的路径。',
      '指定了不支援的路徑。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
  {
    code: 0x4c00,
    meaning: [
      'The information about the access target is wrong.',
      'アクセス先の指定情報に誤りがあります。',
      '访问目标的指定信息有误。',
      '存取目標的指定資訊有誤。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
]
