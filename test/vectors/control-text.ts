/** Frames as people write them: `<ENQ>00FFBR0M00100A<CR><LF>`. */

const CODES: Readonly<Record<string, number>> = {
  STX: 2,
  ETX: 3,
  EOT: 4,
  ENQ: 5,
  ACK: 6,
  LF: 10,
  CL: 12,
  CR: 13,
  DLE: 16,
  NAK: 21,
}

export function controlText(text: string): Buffer {
  const characters = text.replace(/<(\w+)>/g, (whole, name: string) => {
    const code = CODES[name]
    if (code === undefined) throw new Error(`${whole} is no control code`)
    return String.fromCharCode(code)
  })
  return Buffer.from(characters, 'latin1')
}
