import type { Texts } from './entry'

/** What to do, for codes that share it. */
export const remedies = {
  lessPoints: [
    'Ask for fewer points in one request; read() and write() split by themselves when the profile fits the PLC.',
    '1回の要求の点数を減らしてください。プロファイルがPLCに合っていれば、read()とwrite()は自動的に分割します。',
    '请减少单次请求的点数。如果配置文件与PLC相符，read()和write()会自动拆分。',
    '請減少單次請求的點數。如果設定檔與PLC相符，read()和write()會自動拆分。',
  ],
  correctDevice: [
    'Check device name and number against the device settings of the CPU in GX Works.',
    'デバイス名と番号を、GX WorksのCPUデバイス設定と照合してください。',
    '请对照GX Works中CPU的软元件设置，检查软元件名和编号。',
    '請對照GX Works中CPU的軟元件設定，檢查軟元件名稱和編號。',
  ],
  correctRequest: [
    'Correct the request and send it again.',
    '要求内容を修正し、再送してください。',
    '请修改请求内容后重新发送。',
    '請修改請求內容後重新傳送。',
  ],
  correctLength: [
    'The request was built wrongly: report it with a trace. A device between here and the PLC may also change the data.',
    '要求の組立てに誤りがあります。トレースを添えて報告してください。途中の機器がデータを変えている可能性もあります。',
    '请求的构成有误，请附上跟踪记录报告。也可能是中间设备改变了数据。',
    '請求的組成有誤，請附上追蹤記錄回報。也可能是中間裝置改變了資料。',
  ],
  correctRoute: [
    'Check network No., station No., module I/O No. and multidrop station No. of the route.',
    'ルートのネットワーク番号、局番、ユニットI/O番号、マルチドロップ局番を確認してください。',
    '请检查路径的网络号、站号、模块I/O编号和多点站号。',
    '請檢查路徑的網路號、站號、模組I/O編號和多點站號。',
  ],
  otherCommand: [
    'Use a command this module has, and choose the profile that fits the PLC.',
    'このユニットで使用できるコマンドを使用し、PLCに合ったプロファイルを選択してください。',
    '请使用该模块支持的指令，并选择与PLC相符的配置文件。',
    '請使用該模組支援的指令，並選擇與PLC相符的設定檔。',
  ],
  checkPartner: [
    'Check that the other device runs, and check cable, hub and addresses.',
    '相手機器の動作、ケーブル、ハブ、アドレスを確認してください。',
    '请检查对方设备的动作、电缆、集线器和地址。',
    '請檢查對方裝置的動作、電纜、集線器和位址。',
  ],
  retryLater: [
    'Wait a moment and try again.',
    'しばらく待ってから再実行してください。',
    '请稍候再试。',
    '請稍候再試。',
  ],
  lessLoad: [
    'Wait for each answer before the next request, ask less often, and avoid many clients on one station.',
    '応答を待ってから次の要求を送り、要求間隔を長くし、1つの局へのアクセス集中を避けてください。',
    '请在收到响应后再发送下一请求，加大请求间隔，避免集中访问同一站。',
    '請在收到回應後再傳送下一請求，加大請求間隔，避免集中存取同一站。',
  ],
  stopCpu: [
    'Set the CPU to STOP, if the plant allows it, and try again.',
    '設備上問題がなければCPUをSTOPにして、再実行してください。',
    '如果设备允许，请将CPU设为STOP后再试。',
    '如果設備允許，請將CPU設為STOP後再試。',
  ],
  enableOnlineChange: [
    'Tick "Enable online change" in the Ethernet settings of the PLC parameter, or set the CPU to STOP.',
    'PLCパラメータのEthernet設定で「RUN中書込みを許可する」を選択するか、CPUをSTOPにしてください。',
    '请在PLC参数的以太网设置中选择“允许RUN中写入”，或将CPU设为STOP。',
    '請在PLC參數的乙太網路設定中選擇「允許RUN中寫入」，或將CPU設為STOP。',
  ],
  unlockPassword: [
    'Unlock the remote password on this connection first.',
    '先にこのコネクションでリモートパスワードをアンロックしてください。',
    '请先在此连接上解锁远程口令。',
    '請先在此連線上解鎖遠端口令。',
  ],
  correctPassword: [
    'Correct the remote password. It is not tried again by itself, so that the PLC does not lock out.',
    'リモートパスワードを修正してください。ロックアウトを防ぐため自動では再試行しません。',
    '请修正远程口令。为避免PLC锁定，不会自动重试。',
    '請修正遠端口令。為避免PLC鎖定，不會自動重試。',
  ],
  waitLockout: [
    'Wait until the lock-out time is over, then unlock with the right password.',
    'ロックアウト時間の経過を待ち、正しいパスワードでアンロックしてください。',
    '请等待锁定时间结束后，用正确的口令解锁。',
    '請等待鎖定時間結束後，以正確的口令解鎖。',
  ],
  dataCode: [
    'Set the same data code (binary or ASCII) here and in the Ethernet settings of the PLC.',
    'こちらとPLCのEthernet設定で、交信データコード(バイナリ/ASCII)を一致させてください。',
    '请使此处与PLC以太网设置的通信数据代码（二进制/ASCII）一致。',
    '請使此處與PLC乙太網路設定的通訊資料代碼（二進位/ASCII）一致。',
  ],
  checkParameters: [
    'Check the parameters of the module in GX Works and write them again.',
    'GX Worksでユニットのパラメータを確認し、再度書き込んでください。',
    '请在GX Works中检查模块参数并重新写入。',
    '請在GX Works中檢查模組參數並重新寫入。',
  ],
  correctFile: [
    'Check drive, folder and file name.',
    'ドライブ、フォルダ、ファイル名を確認してください。',
    '请检查驱动器、文件夹和文件名。',
    '請檢查磁碟機、資料夾和檔案名稱。',
  ],
  releaseProtection: [
    'Release the write protection of the memory or SD card, or choose another drive.',
    'メモリまたはSDカードの書込み保護を解除するか、別のドライブを指定してください。',
    '请解除存储器或SD卡的写保护，或指定其他驱动器。',
    '請解除記憶體或SD卡的寫入保護，或指定其他磁碟機。',
  ],
  hardware: [
    'Take measures against noise and reset the CPU. If it comes back, a module may be faulty: contact the supplier.',
    'ノイズ対策を行い、CPUをリセットしてください。再発する場合はユニットの故障が考えられます。購入先にご相談ください。',
    '请采取抗干扰措施并复位CPU。如再次发生，可能是模块故障，请联系供应商。',
    '請採取抗干擾措施並重置CPU。如再次發生，可能是模組故障，請聯絡供應商。',
  ],
  program: [
    'Correct the program of the PLC or its control data.',
    'PLCのプログラムまたはコントロールデータを修正してください。',
    '请修改PLC的程序或控制数据。',
    '請修改PLC的程式或控制資料。',
  ],
  openFirst: [
    'Open the connection first, or close and open it again.',
    'コネクションを先にオープンするか、一度クローズしてから再度オープンしてください。',
    '请先打开连接，或关闭后重新打开。',
    '請先開啟連線，或關閉後重新開啟。',
  ],
  serialMessage: [
    'Check the message and the settings of the serial line, then send it again.',
    '電文とシリアル通信設定を確認し、再送してください。',
    '请检查报文和串行通信设置后重新发送。',
    '請檢查報文和序列通訊設定後重新傳送。',
  ],
  serialLine: [
    'Check wiring, termination and the settings of both sides; take measures against noise; let only one device send at a time.',
    '配線、終端抵抗、両側の通信設定を確認し、ノイズ対策を行い、同時送信を避けてください。',
    '请检查接线、终端电阻和双方设置，采取抗干扰措施，避免同时发送。',
    '請檢查接線、終端電阻和雙方設定，採取抗干擾措施，避免同時傳送。',
  ],
  manual: [
    "Look the code up in the manual of the module that reported it, or in GX Works' module diagnostics.",
    'コードを報告したユニットのマニュアル、またはGX Worksのユニット診断で確認してください。',
    '请在报告该代码的模块手册或GX Works的模块诊断中查询。',
    '請在回報該代碼的模組手冊或GX Works的模組診斷中查詢。',
  ],
  ftp: [
    'Check settings, folders and rights of the FTP server, the firewall and the connection.',
    'FTPサーバの設定、フォルダ、権限、ファイアウォール、接続を確認してください。',
    '请检查FTP服务器的设置、文件夹、权限、防火墙和连接。',
    '請檢查FTP伺服器的設定、資料夾、權限、防火牆和連線。',
  ],
} as const satisfies Readonly<Record<string, Texts>>

export type RemedyName = keyof typeof remedies
