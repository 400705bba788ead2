// Character codes of more than one byte, by their tables in iconv-lite.
import type * as Iconv from 'iconv-lite'

/** Code pages 932, 936 and 950: what Windows, and so GX Works, means by Shift-JIS, GBK and Big5. */
export type CodePage = 'cp932' | 'cp936' | 'gb18030' | 'cp950'

/** The tables are large and most programs need none: they are loaded with the first text. */
function iconv(): typeof Iconv {
  return require('iconv-lite') as typeof Iconv
}

/** The bytes; characters the code does not have come out as anything. */
export function encodePage(text: string, page: CodePage): Buffer {
  return iconv().encode(text, page)
}

/** The text; U+FFFD for bytes that are none. */
export function decodePage(bytes: Buffer, page: CodePage): string {
  return iconv().decode(bytes, page)
}
