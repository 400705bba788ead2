// Which messages are the beat of a timer. Node-RED gives them no mark, so it is looked at where they come from: the hook
// tells which node hands a message over. Anything between the timer and the reader may make several messages of one
// beat, or stand for a person, so only what a wire can be made of is looked through.
import type { Node, NodeAPI, NodeDef } from 'node-red'

const HOOK = 'preDeliver.melsec-jw'

/** These hand over what they get, one for one. */
const PASSING: readonly string[] = ['junction', 'link in', 'link out']

/** A node that may be an Inject node; only those have a rhythm. */
interface Sender extends Pick<Node, 'id' | 'type'> {
  /** Milliseconds. */
  readonly repeat?: unknown
  readonly crontab?: unknown
}

/**
 * Looks at what is on its way to the nodes of a type.
 * @returns whether a message came straight from an Inject node with an interval or a schedule
 */
export function timedMessages(RED: NodeAPI, type: string): (message: object) => boolean {
  const senders = new WeakMap<object, Sender>()
  // Of nodes that pass messages on: what is upstream of them, until the next deploy.
  const known = new Map<string, boolean>()
  RED.hooks.remove(HOOK)
  RED.hooks.add(HOOK, ({ msg, source, destination }) => {
    if (destination.node?.type === type) senders.set(msg, source.node)
  })
  RED.events.on('flows:started', () => known.clear())
  return (message) => {
    const sender = senders.get(message)
    // A Link Call node can send to any Link In node, and says so.
    if (sender === undefined || '_linkSource' in message) return false
    if (!PASSING.includes(sender.type)) return isTimer(sender)
    const found = known.get(sender.id) ?? isTimed(RED, sender, [])
    known.set(sender.id, found)
    return found
  }
}

function isTimer({ type, repeat, crontab }: Sender): boolean {
  return type === 'inject' && (Number(repeat) > 0 || Boolean(crontab))
}

/** @param seen on the way here: wires can go in circles */
function isTimed(RED: NodeAPI, node: Sender, seen: readonly string[]): boolean {
  if (!PASSING.includes(node.type)) return isTimer(node)
  if (seen.includes(node.id)) return true
  const before = sendersTo(RED, node.id)
  return before.length > 0 && before.every((each) => isTimed(RED, each, [...seen, node.id]))
}

/** The running nodes with a wire or a link to this one. */
function sendersTo(RED: NodeAPI, id: string): Sender[] {
  const found: Sender[] = []
  RED.nodes.eachNode((node: NodeDef & { readonly wires?: unknown; readonly links?: unknown }) => {
    // A Link In node lists those that link to it, all others those that they link to.
    const to = [node.wires, node.type === 'link in' ? [] : node.links].flat(2)
    const running: Sender | null = to.includes(id) ? RED.nodes.getNode(node.id) : null
    if (running) found.push(running)
  })
  return found
}
