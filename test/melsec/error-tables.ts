// The codes of every table in section 47 of the FX5 communication manual, copied from the manual: what explainEndCode
// must know, and where it must say that the code is seen (names in src/melsec/end-codes/places.ts).

export interface ErrorTable {
  readonly table: string
  readonly place: string
  /** Hexadecimal, ranges with a hyphen. */
  readonly codes: string
}

export const errorTables: readonly ErrorTable[] = [
  {
    table: '47.4 SLMP, CPU module, 3E frame (C06F is only logged)',
    place: '3E',
    codes: 'C035 C050-C054 C056 C058 C059 C05B C05C C05F-C061 C0D8 C200 C201 C204 C810 C815 C816',
  },
  {
    // The end code of a 1E answer is one byte; the manual does not say how it carries these.
    table: '47.4 SLMP, CPU module, column 1E',
    place: '3E',
    codes: 'C035 C050-C054 C056 C059 C05B C05C C05F-C061 C201',
  },
  {
    table: '47.4 SLMP, Ethernet module, 3E frame (C06F is only logged)',
    place: '3E',
    codes: 'C035 C050-C054 C056-C059 C05B C05C C05E-C061 C0D8',
  },
  {
    table: '47.4 SLMP, Ethernet module, column 1E',
    place: '3E',
    codes: 'C035 C050-C054 C056 C057 C059 C05B C05C C05E-C061',
  },
  { table: '47.4 SLMP, only logged', place: 'Ethernet connection', codes: 'C06F' },
  { table: '47.2 MC protocol, 1C frame, NAK', place: '1C', codes: '02 03 06 07 10 18' },
  {
    table: '47.2 MC protocol, 1C frame, CPU module',
    place: 'serial channel',
    codes: '7001 7010 7143 7164 7E40-7E43 7F21-7F24 7F26 7F40 7F67-7F69',
  },
  {
    table: '47.2 MC protocol, 3C and 4C frame, NAK',
    place: '3C/4C',
    codes: '7143 7164 7167 7168 7E40-7E43 7F21-7F24 7F26 7F40 7F67-7F69 7FE6',
  },
  {
    table: '47.2 MC protocol, 3C and 4C frame, CPU module',
    place: 'serial channel',
    codes: '0000 7F40 7F67-7F69',
  },
  { table: '47.2 MC protocol, operation error', place: 'operation error', codes: '2222' },
  { table: '47.1 IP address change, CPU module', place: 'IP address change', codes: '1920 1921' },
  { table: '47.1 IP address change, Ethernet module', place: 'IP address change', codes: '1920 1921' },
  { table: '47.1 IP address change, Un\\G29', place: 'Ethernet module', codes: '1810 1DC4' },
  {
    table: '47.1 simple CPU communication, CPU module',
    place: 'simple CPU communication',
    codes: '4006 4030 4031 C0B2 C201 CFB0-CFB2 CFB4 CFB5',
  },
  {
    table: '47.1 simple CPU communication, Ethernet module',
    place: 'simple CPU communication',
    codes: 'CFB0-CFB5 CFBF',
  },
  {
    table: '47.1 FTP client',
    place: 'FTP client',
    codes: '41C5 41C7 41CC-41CF 41D8 41DF 41E4 41EB 41FE 4C40 4C43 4C44 C035 C616 C618 C619 C620-C622',
  },
  {
    table: '47.1 Ethernet communication, CPU module',
    place: 'Ethernet connection',
    codes:
      '1120 1134 2160 C012 C013 C015 C020 C024 C025 C027 C029 C035 C0B2 C0B6 C0DE C1A2 C1AC C1AD C1AF-C1B1 C1B3 C1B4 C1BA C1C6 C1CC C1CD C1D0 C1D3 C400 C401 C404 C405 C410 C411 C417 C431 C614 CEE0-CEE2 CF10 CF20 CF30 CF31 CF70 CF71 CFB2',
  },
  { table: '47.1 Ethernet communication, CPU module, in SD0', place: 'operation error', codes: '2250' },
  {
    table: '47.1 Ethernet communication, Ethernet module',
    place: 'Ethernet connection',
    codes:
      'C012 C013 C017 C020 C027 C029 C035 C04C C050-C054 C056-C059 C05B C05C C05E-C061 C06F C0D8 C0DE C1A4 C1A6-C1A8 C1AD C1B0-C1B3 C1D3 C709 CF70 CF71',
  },
  {
    table: '47.1 Ethernet module',
    place: 'Ethernet module',
    codes:
      '0800 0904 0910-0913 1080 1811 1812 1852 1861 1870-1877 1900-1904 1D80 1D83-1D85 1E10-1E14 1F00 2160 2C80-2C82 2CF0 2DA0-2DAB 2DB0 3030 3040-3042 3056 3060-3068 306A-306F 3073 3074 3082 3085-3089 3094-309F 30A8-30AA 3CF1 3E30-3E42 3E50-3E56 3E60-3E63 3F92 3FA1 4030-4033 4041 4043 480C-480E',
  },
  {
    table: '47.2 simple PLC link (N:N network)',
    place: 'N:N network',
    codes: '7701-7705 7711 7714 7715 7721-7723 7731',
  },
  {
    table: '47.2 simple PLC link (N:N network), channel',
    place: 'serial channel',
    codes: '7701-7705 7711 7714 7715 7721-7723 7731',
  },
  { table: '47.2 simple PLC link, no data transfer sequence error', place: 'serial channel', codes: '2221' },
  { table: '47.2 parallel link', place: 'serial channel', codes: '2220 2221 7001 7010 7812-7814' },
  {
    table: '47.2 inverter communication',
    place: 'serial channel',
    codes: '7010 7601-7604 7608 7609 7620-762F 7640-764E',
  },
  { table: '47.2 non-protocol communication', place: 'serial channel', codes: '7010 7200 7201' },
  {
    table: '47.2 non-protocol communication, operation error',
    place: 'operation error',
    codes: '1810 2820 2822 3405 3600',
  },
  {
    table: '47.2 predefined protocol support',
    place: 'S(P).CPRTCL',
    codes: '7D00 7D02 7D10 7D12 7D13 7D16-7D1B 7D20 7D21 7F20 7F24 7F67-7F6A 7FF2',
  },
  {
    table: '47.2 predefined protocol support, channel',
    place: 'serial channel',
    codes: '7D00 7D02 7D10 7D12 7D13 7D16-7D1B 7D20 7D21 7F20 7F24 7F67-7F6A 7FF2',
  },
  {
    table: '47.2 predefined protocol support, operation error',
    place: 'operation error',
    codes: '2220-2222 2250 2820 3100 3405 3582',
  },
  {
    table: '47.3 MODBUS, serial',
    place: 'serial channel',
    codes: '7001 7010 7304-730E',
  },
  { table: '47.3 MODBUS/TCP', place: 'Ethernet connection', codes: '7305-7308 7311' },
  { table: '47.3 MODBUS, operation error', place: 'operation error', codes: '1810 2820 2822 3405 3600' },
]

/** `C050-C052 C056` as numbers. */
export function codesOf(list: string): readonly number[] {
  return list.split(' ').flatMap((entry) => {
    const [from = Number.NaN, to = from] = entry.split('-').map((hex) => Number.parseInt(hex, 16))
    return Array.from({ length: to - from + 1 }, (_, index) => from + index)
  })
}
