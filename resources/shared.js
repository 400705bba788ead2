// What the dialogs of all nodes share. The editor loads the files of this folder in any order, before the node types:
// each adds its functions to `melsecJw`, and uses those of the others when a dialog is open only.
;(() => {
  const CATALOGUE = '@melsec-jw/plc/melsec-jw-connection:'
  const SPEECH = ['profile', 'frame', 'code', 'asciiXy', 'asciiZr', 'xyRadix', 'wRadix']
  const JW_SPEECH = ['model', 'marker', 'lists', 'areas', 'ownAreas']
  const PAUSE = 250

  function text(key, values) {
    return RED._(CATALOGUE + key, values)
  }

  /** The palette finds a node by its label and its type. People look for these words, too. */
  const SEARCHED =
    'MELSEC Mitsubishi 三菱 三菱電機 SLMP MC protocol MCプロトコル MC协议 MC協定 PLC iQ-R iQ-F FX3 FX3U FX5 FX5U FX5UJ QnA Q L QJ71E71 Sharp シャープ 夏普 JW JW300 JW30H JW-255CM'
  function addSearchWords() {
    $('.red-ui-palette-node[data-palette-type^="melsec-jw-"]').each(function () {
      const label = $(this).attr('data-palette-label') || ''
      if (label.indexOf(SEARCHED) < 0) $(this).attr('data-palette-label', `${label} ${SEARCHED}`)
    })
  }
  RED.events.on('registry:node-type-added', () => {
    setTimeout(addSearchWords, 0)
  })
  $(document).on('focusin', '#red-ui-palette-search input', addSearchWords)

  /** The manual's name of a command. @param command of the runtime: `{ name, title }` @param family of the PLC */
  function commandTitle(command, family) {
    const key = `${family === 'jw' ? 'jwCommand' : 'command'}.${command.name}`
    const title = text(key)
    return title.indexOf(key) >= 0 ? command.title : title
  }

  /** A number or an environment variable. */
  function isNumber(value, min, max, optional) {
    value = String(value === undefined || value === null ? '' : value).trim()
    if (value === '' || /\$\{.+\}/.test(value)) return value !== '' || Boolean(optional)
    return /^[0-9]+$/.test(value) && Number(value) >= min && Number(value) <= max
  }

  /** A setting of a connection: as chosen in its dialog while that is open, else as it is stored. */
  function chosenIn(connection, field) {
    const open = $('.melsec-jw-form').filter(function () {
      return $(this).data('connection') === connection.id && connection.id !== undefined
    })
    return open.length > 0 ? open.find(`#node-config-input-${field}`).val() : connection[field]
  }

  /** The family of the PLC of a connection, also of none. What is older knows MELSEC only. */
  function familyOf(connection) {
    return (connection && chosenIn(connection, 'family')) || 'melsec'
  }

  /** What the runtime knows of the family of a chosen connection. @param id of the connection */
  function factsOf(id) {
    const families = RED.settings.melsecJwConnectionFamilies || {}
    const name = familyOf(RED.nodes.node(id))
    return { types: [], lacks: [], name, ...families[name] }
  }

  /** Whether the PLC of a chosen connection has nothing for a type of nodes. */
  function lacks(id, type) {
    return factsOf(id).lacks.includes(type)
  }

  /** Whether a connection goes over a serial line; a Sharp JW never does. */
  function isOnLine(connection) {
    return familyOf(connection) === 'melsec' && chosenIn(connection, 'way') === 'serial'
  }

  /** Whether a connection to a Sharp JW has this header. */
  function hasHeader(connection, header) {
    return familyOf(connection) === 'jw' && chosenIn(connection, 'header') === header
  }

  function isUdp(connection) {
    return familyOf(connection) === 'melsec' && !isOnLine(connection) && connection.transport === 'udp'
  }

  /** Whether a connection by this way can have the series. */
  function isSeries(id, onLine) {
    const facts = RED.settings.melsecJwConnectionProfiles?.[id]
    return Boolean(id) && (facts === undefined || (facts.serial !== undefined) === onLine)
  }

  /** Where the PLC is, where no name says it. */
  function placeOf(connection) {
    if (!isOnLine(connection)) return connection.host ? `${connection.host}:${connection.port}` : ''
    const line = RED.nodes.node(connection.line)
    const name = line ? line.name || line.path || (line.host ? `${line.host}:${line.port}` : '') : ''
    return name && text('line.place', { line: name, station: connection.lineStation || 0 })
  }

  /** The frame a connection speaks: its own, or the usual one of its series. Without a series it is 3E. */
  function frameOf(connection) {
    if (isOnLine(connection)) return RED.nodes.node(connection.line)?.frame || '3C'
    if (familyOf(connection) === 'jw') return ''
    const facts = RED.settings.melsecJwConnectionProfiles?.[connection.profile] || {}
    return connection.frame || facts.frame || '3E'
  }

  function post(path, body) {
    return $.ajax({ url: path, type: 'POST', contentType: 'application/json', data: JSON.stringify(body) })
  }

  /** What of the chosen connection decides how addresses are written. */
  function speechOf(id) {
    const connection = RED.nodes.node(id)
    const family = familyOf(connection)
    const speech = family === 'jw' ? { family } : {}
    ;(family === 'jw' ? JW_SPEECH : SPEECH).forEach((field) => {
      if (connection?.[field]) speech[field] = connection[field]
    })
    if (!connection || !isOnLine(connection)) return speech
    const line = RED.nodes.node(connection.line) || {}
    const { frame: _frame, code: _code, ...common } = speech
    return { ...common, way: 'serial', lineFrame: line.frame, messageFormat: line.messageFormat }
  }

  /** Does something a moment after each change; `run` gets a function that says whether its answer is still wanted. */
  function delayed(run) {
    let timer
    let number = 0
    function start() {
      const mine = ++number
      run(() => mine === number)
    }
    return {
      soon: () => {
        clearTimeout(timer)
        timer = setTimeout(start, PAUSE)
      },
      stop: () => {
        clearTimeout(timer)
        number += 1
      },
    }
  }

  /** Settings that the flow does not have, being older or written by hand, get their usual value. */
  function fill(node, prefix) {
    Object.keys(node._def.defaults).forEach((name) => {
      const input = $(`#node-${prefix}input-${name}`)
      if (node[name] !== undefined || input.is(':checkbox') || name === 'items') return
      input.val(node._def.defaults[name].value)
    })
  }

  window.melsecJw = Object.assign(window.melsecJw || {}, {
    text,
    isNumber,
    familyOf,
    factsOf,
    lacks,
    hasHeader,
    isOnLine,
    isUdp,
    isSeries,
    placeOf,
    post,
    commandTitle,
    speechOf,
    delayed,
    fill,
    frameOf,
  })
})()
