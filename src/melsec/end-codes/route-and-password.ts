// End codes about block counts, routes to other stations and the remote password.
import { BACKGROUND, type EndCodeEntry, FX5_ETHERNET, FX5_SLMP } from './entry'

export const routeAndPasswordEndCodes: readonly EndCodeEntry[] = [
  {
    code: 0xc0d3,
    meaning: [
      'The way to the target has too many relay stations.',
      '他ネットワークへの中継局数が範囲外です。',
      '到其他网络的中继站数超出范围。',
      '到其他網路的中繼站數超出範圍。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
  {
    code: 0xc0d4,
    meaning: [
      'The way to the target has too many relay stations.',
      '他ネットワークへの中継局数が範囲外です。',
      '到其他网络的中继站数超出范围。',
      '到其他網路的中繼站數超出範圍。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
  {
    code: 0xc0d8,
    meaning: [
      'Too many blocks in one Read Block or Write Block.',
      '指定ブロック数が範囲を超えています。',
      '指定的块数超出范围。',
      '指定的區塊數超出範圍。',
    ],
    remedy: 'lessPoints',
    source: FX5_SLMP,
  },
  {
    code: 0xc0d9,
    meaning: [
      'The subcommand is wrong.',
      'サブコマンドの指定に誤りがあります。',
      '子指令的指定有误。',
      '子指令的指定有誤。',
    ],
    remedy: 'otherCommand',
    source: BACKGROUND,
  },
  {
    code: 0xc0de,
    meaning: [
      'Receiving a socket message failed, or nothing arrived within the arrival monitoring time.',
      'ソケット通信の受信に失敗したか、到達監視時間以内にデータを受信できませんでした。',
      'Socket通信的接收失败，或在到达监视时间以内未收到数据。',
      'Socket通訊的接收失敗，或在到達監視時間以內未收到資料。',
    ],
    remedy: 'checkPartner',
    source: `${FX5_ETHERNET}; arrival monitoring time ${BACKGROUND}`,
  },
  {
    code: 0xc1a2,
    meaning: [
      'The target station did not answer, or more than seven relays are on the way.',
      '要求に対する応答を受信できないか、他ネットワークへの中継が7局を超えています。',
      '未收到对请求的响应，或到其他网络的中继超过7站。',
      '未收到對請求的回應，或到其他網路的中繼超過7站。',
    ],
    remedy: [
      'Wait longer for the response, and check the route and the target station.',
      '応答待ち時間を長くし、ルートと対象局を確認してください。',
      '请延长响应等待时间，并检查路径和对象站。',
      '請延長回應等待時間，並檢查路徑和對象站。',
    ],
    source: `${FX5_ETHERNET}; relays ${BACKGROUND}`,
  },
  {
    code: 0xc1a4,
    meaning: [
      'Command, subcommand or module I/O No. is wrong, or the target does not support the function.',
      'コマンド、サブコマンド、要求先ユニットI/O番号のいずれかに誤りがあるか、対象機器が対応していません。',
      '指令、子指令或请求目标模块I/O编号有误，或对象设备不支持该功能。',
      '指令、子指令或請求目標模組I/O編號有誤，或對象裝置不支援該功能。',
    ],
    remedy: [
      'Correct the request and its route. Ethernet diagnostics of an FX5 need a direct connection to the CPU, not to the Ethernet module.',
      '要求内容とルートを修正してください。FX5のEthernet診断は、EthernetユニットではなくCPUに直結して実行してください。',
      '请修改请求内容和路径。FX5的以太网诊断请直接连接CPU模块执行，而不是以太网模块。',
      '請修改請求內容和路徑。FX5的乙太網路診斷請直接連接CPU模組執行，而不是乙太網路模組。',
    ],
    source: `${FX5_ETHERNET}; command and route ${BACKGROUND}`,
  },
  {
    code: 0xc1a5,
    meaning: [
      'The target station is wrong.',
      '対象局の指定に誤りがあります。',
      '对象站的指定有误。',
      '對象站的指定有誤。',
    ],
    remedy: 'correctRoute',
    source: BACKGROUND,
  },
  {
    code: 0xc1a7,
    meaning: [
      'The network No. is wrong.',
      'ネットワーク番号の指定に誤りがあります。',
      '网络号的指定有误。',
      '網路號的指定有誤。',
    ],
    remedy: 'correctRoute',
    source: FX5_ETHERNET,
  },
  {
    code: 0xc1a8,
    meaning: ['The station No. is wrong.', '局番の指定に誤りがあります。', '站号的指定有误。', '站號的指定有誤。'],
    remedy: 'correctRoute',
    source: FX5_ETHERNET,
  },
  {
    code: 0xc1a9,
    meaning: [
      'The device number is wrong.',
      'デバイス番号の指定に誤りがあります。',
      '软元件编号的指定有误。',
      '軟元件編號的指定有誤。',
    ],
    remedy: 'correctDevice',
    source: BACKGROUND,
  },
  {
    code: 0xc1aa,
    meaning: [
      'The device name is wrong.',
      'デバイス名の指定に誤りがあります。',
      '软元件名的指定有误。',
      '軟元件名稱的指定有誤。',
    ],
    remedy: 'correctDevice',
    source: BACKGROUND,
  },
  {
    code: 0xc200,
    meaning: [
      'The remote password is wrong.',
      'リモートパスワードに誤りがあります。',
      '远程口令有误。',
      '遠端口令有誤。',
    ],
    remedy: 'correctPassword',
    source: FX5_SLMP,
  },
  {
    code: 0xc201,
    meaning: [
      'The port is locked by the remote password.',
      '交信に使用したポートはリモートパスワードでロックされています。',
      '通信所使用的端口处于远程口令锁定状态。',
      '通訊所使用的連接埠處於遠端口令鎖定狀態。',
    ],
    remedy: 'unlockPassword',
    source: FX5_SLMP,
  },
  {
    code: 0xc202,
    meaning: [
      'The remote password of another station could not be unlocked.',
      '他局へのアクセス時にリモートパスワードをアンロックできませんでした。',
      '访问其他站时无法解锁远程口令。',
      '存取其他站時無法解鎖遠端口令。',
    ],
    remedy: [
      'Set no remote password for the relay stations and the target, or connect to the target directly.',
      '中継局と対象局にリモートパスワードを設定しないか、対象局に直接接続してください。',
      '请勿对中继站和对象站设置远程口令，或直接连接对象站。',
      '請勿對中繼站和對象站設定遠端口令，或直接連接對象站。',
    ],
    source: BACKGROUND,
  },
  {
    code: 0xc203,
    meaning: [
      'The check of the remote password failed.',
      'リモートパスワードのチェックでエラーが発生しました。',
      '远程口令检查时发生错误。',
      '遠端口令檢查時發生錯誤。',
    ],
    remedy: 'correctPassword',
    source: BACKGROUND,
  },
  {
    code: 0xc204,
    meaning: [
      'Another device unlocked the remote password; only that one can lock it.',
      'リモートパスワードをアンロックした機器と異なる機器からの要求です。',
      '与请求远程口令解锁的设备不同。',
      '與請求遠端口令解鎖的裝置不同。',
    ],
    remedy: [
      'Lock it from the device that unlocked it.',
      'アンロックした機器からロックしてください。',
      '请由解锁的设备进行锁定。',
      '請由解鎖的裝置進行鎖定。',
    ],
    source: FX5_SLMP,
  },
  {
    code: 0xc205,
    meaning: [
      'The remote password of another station could not be unlocked.',
      '他局へのアクセス時にリモートパスワードをアンロックできませんでした。',
      '访问其他站时无法解锁远程口令。',
      '存取其他站時無法解鎖遠端口令。',
    ],
    remedy: 'correctPassword',
    source: BACKGROUND,
  },
  {
    code: 0xc207,
    meaning: [
      'The file name has too many characters.',
      'ファイル名の文字数が多すぎます。',
      '文件名的字符数过多。',
      '檔案名稱的字元數過多。',
    ],
    remedy: 'correctFile',
    source: BACKGROUND,
  },
  {
    code: 0xc208,
    meaning: [
      'The password is too short or too long.',
      'パスワードの長さが範囲外です。',
      '口令的长度超出范围。',
      '口令的長度超出範圍。',
    ],
    remedy: [
      'Q and L: 4 characters. iQ-R and iQ-F: 6 to 32 characters.',
      'Q/Lは4文字、iQ-R/iQ-Fは6～32文字にしてください。',
      'Q/L：4个字符。iQ-R/iQ-F：6～32个字符。',
      'Q/L：4個字元。iQ-R/iQ-F：6～32個字元。',
    ],
    source: BACKGROUND,
  },
  {
    code: 0xc810,
    meaning: [
      'The remote password is wrong (9 failures or fewer).',
      'リモートパスワードに誤りがあります(認証失敗9回以下)。',
      '远程口令有误（认证失败9次以下）。',
      '遠端口令有誤（認證失敗9次以下）。',
    ],
    remedy: 'correctPassword',
    source: FX5_SLMP,
  },
  {
    code: 0xc815,
    meaning: [
      'The remote password is wrong for the 10th time; the PLC locks out.',
      'リモートパスワードに誤りがあります(認証失敗10回)。ロックアウトされます。',
      '远程口令有误（认证失败10次），进入锁定。',
      '遠端口令有誤（認證失敗10次），進入鎖定。',
    ],
    remedy: 'waitLockout',
    source: FX5_SLMP,
  },
  {
    code: 0xc816,
    meaning: [
      'The remote password is locked out after too many failures.',
      'リモートパスワードの認証はロックアウト中です。',
      '远程口令认证处于锁定中。',
      '遠端口令認證處於鎖定中。',
    ],
    remedy: 'waitLockout',
    source: FX5_SLMP,
  },
]
