// The Test button of a connection: what came of it, and what else to try.
;(() => {
  /** Everything in the open dialog of a connection. */
  function typedSettings(definition) {
    const settings = {}
    Object.keys(definition.defaults).forEach((field) => {
      const input = $(`#node-config-input-${field}`)
      if (input.length > 0) settings[field] = input.is(':checkbox') ? input.prop('checked') : input.val()
    })
    return settings
  }

  function isJw() {
    return $('#node-config-input-family').val() === 'jw'
  }

  function isOnLine() {
    return !isJw() && $('#node-config-input-way').val() === 'serial'
  }

  /** The serial line of the open dialog, as it stands in the editor. */
  function lineSettings() {
    const line = RED.nodes.node($('#node-config-input-line').val())
    if (!isOnLine() || !line) return {}
    return { line: Object.fromEntries(Object.keys(line._def.defaults).map((field) => [field, line[field]])) }
  }

  /** @param name class of the box, which says by its colour how it went */
  function resultBox(name, icon, title) {
    const box = $('#melsec-jw-test-result').empty().removeClass('melsec-jw-good melsec-jw-bad').addClass(name)
    $('<div class="melsec-jw-result-title">')
      .append($('<i aria-hidden="true">').addClass(`fa ${icon}`), document.createTextNode(melsecJw.text(title)))
      .appendTo(box)
    return box
  }

  function showFailure(result) {
    const box = resultBox('melsec-jw-bad', 'fa-times-circle', 'test.failed')
    const causes = result.causes || []
    $('<div>').text(result.message).appendTo(box)
    if (causes.length > 0) {
      $('<div>').text(melsecJw.text('test.causes')).appendTo(box)
      const ordered = $('<ol>').appendTo(box)
      causes.forEach((cause) => {
        $('<li>').text(cause).appendTo(ordered)
      })
    }
    return box
  }

  /** What the PLC answered to; one click takes a line over. */
  function showFound(node, lines) {
    const box = resultBox('melsec-jw-good', 'fa-check-circle', 'test.found')
    lines.forEach((line) => {
      const what = [node._(`option.${line.frame}`), node._(`option.${line.code}`), line.model]
        .filter(Boolean)
        .join(' · ')
      $('<div>')
        .append(
          $('<button type="button" class="red-ui-button red-ui-button-small">')
            .text(melsecJw.text('test.use', { what: what }))
            .on('click', () => {
              if (line.profile) $('#node-config-input-profile').val(line.profile).trigger('change')
              $('#node-config-input-code').val(line.code).trigger('change')
              $('#node-config-input-frame').val(line.frame).trigger('change')
              box.empty()
              $('#melsec-jw-test').trigger('click')
            }),
        )
        .appendTo(box)
    })
  }

  /** The stations of a line that answer; one click takes one over. */
  function showStations(stations) {
    const box = resultBox('melsec-jw-good', 'fa-check-circle', 'test.foundStations')
    const series = $('#node-config-input-profile')
    stations.forEach((found) => {
      const what = [melsecJw.text('test.station', { station: found.station }), found.model].filter(Boolean).join(' · ')
      const offered = series.find('option').filter(function () {
        return this.value === found.profile
      })
      $('<div>')
        .append(
          $('<button type="button" class="red-ui-button red-ui-button-small">')
            .text(melsecJw.text('test.use', { what: what }))
            .on('click', () => {
              if (offered.length > 0) series.val(found.profile).trigger('change')
              $('#node-config-input-lineStation').val(String(found.station)).trigger('change')
              box.empty()
              $('#melsec-jw-test').trigger('click')
            }),
        )
        .appendTo(box)
    })
  }

  /** Ways to speak that were answered: the line has them, for all of its stations. */
  function showForms({ station, forms }) {
    const box = resultBox('melsec-jw-good', 'fa-check-circle', 'test.foundForms')
    forms.forEach((form) => {
      const sum = melsecJw.text(form.sumCheck ? 'test.withSum' : 'test.withoutSum')
      const what = [
        melsecJw.text('test.station', { station }),
        `${form.frame}`,
        melsecJw.text('test.format', { format: form.messageFormat }),
        sum,
      ]
      $('<div>').text(what.join(' · ')).appendTo(box)
    })
    $('<div class="melsec-jw-hint">').text(melsecJw.text('test.setInLine')).appendTo(box)
  }

  /** The headers that a unit answers; one click takes one over. */
  function showHeaders(node, headers) {
    const box = resultBox('melsec-jw-good', 'fa-check-circle', 'test.foundHeader')
    headers.forEach(({ header }) => {
      $('<div>')
        .append(
          $('<button type="button" class="red-ui-button red-ui-button-small">')
            .text(melsecJw.text('test.use', { what: node._(`option.header.${header}`) }))
            .on('click', () => {
              $('#node-config-input-header').val(header).trigger('change')
              box.empty()
              $('#melsec-jw-test').trigger('click')
            }),
        )
        .appendTo(box)
    })
  }

  /** What a Sharp JW says of itself; what it does not tell is left out. */
  function showJw(box, { memorySize, runState, writeMode }) {
    const memory = memorySize?.kiloWords
    const told = [
      memory && melsecJw.text('test.jwMemory', { size: memory }),
      runState && melsecJw.text(`test.runState.${runState}`),
      writeMode && melsecJw.text(`test.writeMode.${writeMode}`),
    ].filter(Boolean)
    $('<div>')
      .text(told.length > 0 ? told.join(' · ') : melsecJw.text('test.cpu', { cpu: melsecJw.text('test.unidentified') }))
      .appendTo(box)
    if (writeMode === 'none') $('<div class="melsec-jw-hint">').text(melsecJw.text('test.noWrites')).appendTo(box)
  }

  function showCpu(box, result) {
    const cpu =
      result.model === undefined
        ? melsecJw.text('test.unidentified')
        : [result.model, result.series].filter(Boolean).join(' · ')
    $('<div>')
      .text(melsecJw.text('test.cpu', { cpu: cpu }))
      .appendTo(box)
  }

  function showResult(result) {
    const box = resultBox('melsec-jw-good', 'fa-check-circle', 'test.good')
    if (result.jw) showJw(box, result.jw)
    else showCpu(box, result)
    if (result.unidentified) $('<div class="melsec-jw-hint">').text(result.unidentified).appendTo(box)
    if (result.warning?.code === 'W_RADIX') {
      $('<div class="melsec-jw-hint">')
        .text(melsecJw.text('test.wRadix', { model: result.model }))
        .appendTo(box)
    }
    const times = result.roundTrip
    function ms(value) {
      return value.toFixed(value < 10 ? 2 : 0)
    }
    $('<div>')
      .text(
        melsecJw.text('test.roundTrip', {
          mean: ms(times.mean),
          min: ms(times.min),
          max: ms(times.max),
          rounds: times.count,
        }),
      )
      .appendTo(box)
    suggest(box, result.profile)
  }

  /** The series that the CPU says it is of, when another one is chosen. */
  function suggest(box, profile) {
    const select = $('#node-config-input-profile')
    const option = select.find('option').filter(function () {
      return profile && this.value === profile
    })
    if (option.length === 0 || select.val() === profile) return
    $('<button type="button" class="red-ui-button red-ui-button-small">')
      .text(melsecJw.text('test.useSeries', { series: option.text() }))
      .appendTo(box)
      .on('click', function () {
        select.val(profile).trigger('change')
        $(this).remove()
      })
  }

  /** What else can be tried, by family and way. */
  const HEADERS = { ask: 'test.findHeader', running: 'test.findingHeader' }
  const STATIONS = { ask: 'test.findStations', running: 'test.findingStations' }
  const FRAMES = { ask: 'test.find', running: 'test.finding' }

  function prepareTest(node) {
    function askPlc(path, running, show) {
      const buttons = $('#melsec-jw-test').prop('disabled', true)
      $('#melsec-jw-test-result').removeClass('melsec-jw-good melsec-jw-bad').text(melsecJw.text(running))
      melsecJw
        .post(`melsec-jw/connection/${path}`, { id: node.id, settings: typedSettings(node._def), ...lineSettings() })
        .then(show, (failed) => {
          const message = failed.responseJSON?.message
          showFailure({
            message:
              message ||
              melsecJw.text(failed.status === 401 || failed.status === 403 ? 'test.notPermitted' : 'test.noAnswer'),
          })
        })
        .always(() => {
          buttons.prop('disabled', false)
        })
    }
    $('#melsec-jw-test').on('click', () => {
      askPlc('test', 'test.running', (result) => {
        if (result.ok) return showResult(result)
        const box = showFailure(result)
        if (!result.mayFind) return
        const search = isJw() ? HEADERS : isOnLine() ? STATIONS : FRAMES
        $('<button type="button" class="red-ui-button red-ui-button-small">')
          .text(melsecJw.text(search.ask))
          .appendTo(box)
          .on('click', () => {
            askPlc('find', search.running, (found) => {
              if (!found.ok) showFailure(found)
              else if (found.headers) showHeaders(node, found.headers)
              else if (found.stations) showStations(found.stations)
              else if (found.forms) showForms(found)
              else showFound(node, found.lines)
            })
          })
      })
    })
  }

  window.melsecJw = Object.assign(window.melsecJw || {}, { prepareTest })
})()
