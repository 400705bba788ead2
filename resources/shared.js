// What the dialogs of all nodes share. The editor loads the files of this folder in any order, before the node types:
// each adds its functions to `melsecJw`, and uses those of the others when a dialog is open only.
;(() => {
  const CATALOGUE = '@melsec-jw/plc/melsec-jw-connection:'
  const SPEECH = ['profile', 'frame', 'code', 'asciiXy', 'asciiZr', 'xyRadix', 'wRadix']
  const PAUSE = 250

  function text(key, values) {
    return RED._(CATALOGUE + key, values)
  }

  /** The palette finds a node by its label and its type. People look for these words, too. */
  const SEARCHED =
    'MELSEC Mitsubishi 三菱 三菱電機 SLMP MC protocol MCプロトコル MC协议 MC協定 PLC iQ-R iQ-F FX3 FX3U FX5 FX5U FX5UJ QnA Q L QJ71E71'
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

  /** The manual's name of a command. @param command of the runtime: `{ name, title }` */
  function commandTitle(command) {
    const key = `command.${command.name}`
    const title = text(key)
    return title.indexOf(key) >= 0 ? command.title : title
  }

  /** A number or an environment variable. */
  function isNumber(value, min, max, optional) {
    value = String(value === undefined || value === null ? '' : value).trim()
    if (value === '' || /\$\{.+\}/.test(value)) return value !== '' || Boolean(optional)
    return /^[0-9]+$/.test(value) && Number(value) >= min && Number(value) <= max
  }

  /** Whether a connection goes over a serial line: as chosen in its dialog while that is open, else as it is stored. */
  function isOnLine(connection) {
    const open = $('.melsec-jw-form').filter(function () {
      return $(this).data('connection') === connection.id && connection.id !== undefined
    })
    return (open.length > 0 ? open.find('#node-config-input-way').val() : connection.way) === 'serial'
  }

  function isUdp(connection) {
    return !isOnLine(connection) && connection.transport === 'udp'
  }

  /** Whether a connection by this way can have the series. */
  function isSeries(id, onLine) {
    const facts = RED.settings.melsecJwConnectionProfiles?.[id]
    return Boolean(id) && (facts === undefined || (facts.serial !== undefined) === onLine)
  }

  /** Where the PLC is, where no name says it. */
  function placeOf(connection) {
    if (connection.way !== 'serial') return connection.host ? `${connection.host}:${connection.port}` : ''
    const line = RED.nodes.node(connection.line)
    const name = line ? line.name || line.path || (line.host ? `${line.host}:${line.port}` : '') : ''
    return name && text('line.place', { line: name, station: connection.lineStation || 0 })
  }

  /** The frame a connection speaks: its own, or the usual one of its series. Without a series it is 3E. */
  function frameOf(connection) {
    if (connection.way === 'serial') return RED.nodes.node(connection.line)?.frame || '3C'
    const facts = RED.settings.melsecJwConnectionProfiles?.[connection.profile] || {}
    return connection.frame || facts.frame || '3E'
  }

  function post(path, body) {
    return $.ajax({ url: path, type: 'POST', contentType: 'application/json', data: JSON.stringify(body) })
  }

  /** What of the chosen connection decides how addresses are written. */
  function speechOf(id) {
    const connection = RED.nodes.node(id)
    const speech = {}
    SPEECH.forEach((field) => {
      if (connection?.[field]) speech[field] = connection[field]
    })
    if (connection?.way !== 'serial') return speech
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
