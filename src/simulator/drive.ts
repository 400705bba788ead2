// A memory with files of the simulated PLC, in this program's own memory. Names do not distinguish capital letters.
import type { FileTime } from '../melsec/file/time'

/** A file or directory as a list of files has it. */
export interface DriveEntry {
  readonly name: string
  readonly directory: boolean
  /** Bytes; 0 of a directory. */
  readonly size: number
  readonly modified: FileTime
  readonly readOnly: boolean
}

/** Names from the root to a file or directory; none is the root itself. */
export type DrivePath = readonly string[]

/** Where files are kept. Whoever calls has checked that what a method needs is there. */
export interface DriveStore {
  /** What a directory holds, in an order that stays; `undefined`: there is no such directory. */
  list(path: DrivePath): readonly DriveEntry[] | undefined
  find(path: DrivePath): DriveEntry | undefined
  /** Bytes that all files take. */
  used(): number
  read(path: DrivePath, offset: number, length: number): Buffer
  write(path: DrivePath, offset: number, data: Uint8Array): void
  /** A new file of zeros in a directory that is there. */
  create(path: DrivePath, size: number, modified: FileTime): void
  remove(path: DrivePath): void
  setReadOnly(path: DrivePath, readOnly: boolean): void
  setModified(path: DrivePath, modified: FileTime): void
}

/** The same for all spellings of a path. */
export function keyOf(path: DrivePath): string {
  return path.join('\\').toUpperCase()
}

/** Names that mean a device on Windows, with any extension. */
const DEVICES = /^(con|prn|aux|nul|com\d|lpt\d)(\.|$)/i

/** Whether a name means an entry of its directory and nothing else, on whatever system this runs. */
export function isPlainName(name: string): boolean {
  if (name === '' || /["*/\\:<>?|\p{Cc}\p{Surrogate}\ufffd]/u.test(name)) return false
  return !/^\.\.?$|[. ]$/.test(name) && !DEVICES.test(name)
}

/**
 * The names of a path from the root, with or without a separator in front; `undefined` when it is none.
 * @example pathOf('LOG\\LINE.CSV') // ['LOG', 'LINE.CSV']
 */
export function pathOf(text: string): DrivePath | undefined {
  const names = (text.startsWith('\\') ? text.slice(1) : text).split('\\')
  return names.every(isPlainName) ? names : undefined
}

interface Node {
  name: string
  /** Files and directories in it by key; of a file `undefined`. */
  readonly children: Map<string, Node> | undefined
  data: Buffer
  modified: FileTime
  readOnly: boolean
}

function newNode(name: string, directory: boolean, modified: FileTime): Node {
  return {
    name,
    children: directory ? new Map() : undefined,
    data: Buffer.alloc(0),
    modified,
    readOnly: false,
  }
}

function entryOf({ name, children, data, modified, readOnly }: Node): DriveEntry {
  return { name, directory: children !== undefined, size: data.length, modified, readOnly }
}

export class MemoryDrive implements DriveStore {
  readonly #root: Node

  constructor(modified: FileTime) {
    this.#root = newNode('', true, modified)
  }

  /** Makes the directories on the way to a file. */
  makeDirectories(path: DrivePath, modified: FileTime): void {
    let node = this.#root
    for (const name of path) {
      const key = keyOf([name])
      const next = node.children?.get(key) ?? newNode(name, true, modified)
      node.children?.set(key, next)
      node = next
    }
  }

  list(path: DrivePath): readonly DriveEntry[] | undefined {
    const children = this.#at(path)?.children
    return children === undefined ? undefined : [...children.values()].map(entryOf)
  }

  find(path: DrivePath): DriveEntry | undefined {
    const node = this.#at(path)
    return node === undefined ? undefined : entryOf(node)
  }

  used(): number {
    const sum = ({ data, children }: Node): number =>
      data.length + [...(children?.values() ?? [])].reduce((total, child) => total + sum(child), 0)
    return sum(this.#root)
  }

  read(path: DrivePath, offset: number, length: number): Buffer {
    return Buffer.from(this.#must(path).data.subarray(offset, offset + length))
  }

  write(path: DrivePath, offset: number, data: Uint8Array): void {
    this.#must(path).data.set(data, offset)
  }

  create(path: DrivePath, size: number, modified: FileTime): void {
    const name = path.at(-1) ?? ''
    const node = newNode(name, false, modified)
    node.data = Buffer.alloc(size)
    this.#must(path.slice(0, -1)).children?.set(keyOf([name]), node)
  }

  remove(path: DrivePath): void {
    this.#must(path.slice(0, -1)).children?.delete(keyOf(path.slice(-1)))
  }

  setReadOnly(path: DrivePath, readOnly: boolean): void {
    this.#must(path).readOnly = readOnly
  }

  setModified(path: DrivePath, modified: FileTime): void {
    this.#must(path).modified = modified
  }

  #at(path: DrivePath): Node | undefined {
    let node: Node | undefined = this.#root
    for (const name of path) node = node?.children?.get(keyOf([name]))
    return node
  }

  #must(path: DrivePath): Node {
    const node = this.#at(path)
    if (node === undefined) throw new TypeError(`${keyOf(path)} is not there`)
    return node
  }
}
