// One serial line shared by the connections to the PLCs on it.
import type { Node } from 'node-red'
import { createMelsecLine, type MelsecLine, type MelsecLineOptions } from '../src/index'
import { detailsOf, NodeFailure, refusal } from './failure'
import type { Texts } from './texts'

/**
 * The line of one line node. Nothing is opened here: the library opens it with the first client that is connected, and closes
 * it with the last.
 */
export class PlcLine {
  private constructor(
    private readonly texts: Texts,
    readonly options: MelsecLineOptions | undefined,
    private readonly opened: MelsecLine | undefined,
    /** Why there is none; every connection on it reports it. */
    readonly failure: NodeFailure | undefined,
  ) {}

  /**
   * Never throws: wrong settings become the `failure` of every connection that is on the line.
   * @param optionsOf reads the settings
   */
  static of(texts: Texts, optionsOf: () => MelsecLineOptions): PlcLine {
    try {
      const options = optionsOf()
      return new PlcLine(texts, options, createMelsecLine(options), undefined)
    } catch (error) {
      const details = detailsOf(error, texts)
      const code = details.code === 'UNEXPECTED' ? details.code : 'NOT_CONFIGURED'
      return new PlcLine(texts, undefined, undefined, new NodeFailure({ ...details, code }))
    }
  }

  /** @throws NodeFailure NOT_CONFIGURED when the settings of the line are wrong */
  get line(): MelsecLine {
    if (this.opened !== undefined) return this.opened
    throw refusal('NOT_CONFIGURED', this.texts('error.line', { message: this.failure?.message ?? '' }), {
      field: 'line',
    })
  }

  get isOpen(): boolean {
    return this.opened?.isOpen === true
  }

  /** Whether it is set as these options say. */
  isLike(options: MelsecLineOptions): boolean {
    return this.options !== undefined && JSON.stringify(this.options) === JSON.stringify(options)
  }

  /** Whether it is at the same port as these options say. */
  isAt(options: MelsecLineOptions): boolean {
    return this.options !== undefined && placeOf(this.options) === placeOf(options)
  }
}

/** A port under another name is found out by the system, which lets nobody else open it. */
function placeOf({ serial, host, port }: MelsecLineOptions): string {
  return serial?.path ?? `${host}:${port}`
}

/** The lines that run, by their nodes. Another copy of this package has nodes of its own. */
const lines = new Map<Node, PlcLine>()

/** @returns what takes it away again */
export function setLine(node: Node, line: PlcLine): () => void {
  lines.set(node, line)
  return () => {
    lines.delete(node)
  }
}

/** @param node what `RED.nodes.getNode` gave, `null` included */
export function lineOf(node: Node | null | undefined): PlcLine | undefined {
  return node ? lines.get(node) : undefined
}

/** A line that has this port open and is another one than `options` say. */
export function lineAt(options: MelsecLineOptions): PlcLine | undefined {
  return [...lines.values()].find((line) => line.isOpen && line.isAt(options))
}
