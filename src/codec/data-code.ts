import { AsciiReader, AsciiWriter } from './ascii'
import { BinaryReader, BinaryWriter } from './binary'
import type { Reader, Writer } from './cursor'

/** How numbers travel. A setting of the PLC's port, never negotiated. */
export type DataCode = 'binary' | 'ascii'

/** A writer of the code, whose device form is `form`. */
export function writerOf(code: DataCode, form = 0): Writer {
  const writer = code === 'ascii' ? new AsciiWriter() : new BinaryWriter()
  writer.form = form
  return writer
}

/** A reader of the code over `bytes`. */
export function readerOf(code: DataCode, bytes: Buffer, form = 0): Reader {
  return code === 'ascii' ? new AsciiReader(bytes, form) : new BinaryReader(bytes, form)
}
