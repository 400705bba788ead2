// Putting nodes on an editor tab: ids, places, and the frames drawn round them.

const ROW = 50
const LEFT = 40
/** The frame's title, and half a node. */
const TOP = 60

/** About as wide as the editor will draw the node: it stores its middle, and columns look tidy at the left. */
function widthOf({ type, name, label }) {
  if (type.startsWith('link ')) return 30
  const text = name || label || ''
  const button = type === 'inject' ? 1 : 0
  return Math.max(100, 20 * Math.ceil((text.length * 6.9 + 50 + 10 * button) / 20))
}

/**
 * A tab whose nodes' ids begin with `prefix`.
 * @param info description in Markdown
 */
export function tab(prefix, label, info) {
  const id = `${prefix}-tab`
  const nodes = [{ id, type: 'tab', label, disabled: false, info }]
  const name = (short) => `${prefix}-${short}`
  const put = ({ id: own, type, column, row, wires = [[]], ...rest }, { x, y, frame }) => {
    const place = { x: x + LEFT + column + widthOf({ type, ...rest }) / 2, y: y + TOP + row * ROW }
    nodes.push({ id: name(own), type, z: id, ...frame, ...rest, ...place, wires: wires.map((port) => port.map(name)) })
  }
  return {
    nodes,
    name,
    /** A framed area with its nodes, each with a `column` in pixels and a `row`. */
    frame(short, title, { x, y, width, rows }, contents) {
      nodes.push({
        id: name(short),
        type: 'group',
        z: id,
        name: title,
        style: { label: true, stroke: '#a4a4a4', fill: '#eef3f8', 'fill-opacity': '0.5', color: '#333333' },
        nodes: contents.map((node) => name(node.id)),
        x,
        y,
        w: width,
        h: TOP + (rows - 1) * ROW + 40,
      })
      for (const node of contents) put(node, { x, y, frame: { g: name(short) } })
    },
    linkOut: ({ to, ...node }) => ({ ...node, type: 'link out', mode: 'link', links: to.map(name), wires: [] }),
    linkIn: ({ from, ...node }) => ({ ...node, type: 'link in', links: from.map(name) }),
  }
}
