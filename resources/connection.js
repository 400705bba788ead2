// The dialog of a connection: what a series makes of its fields, and the Test button.
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

  function showResult(result) {
    const box = resultBox('melsec-jw-good', 'fa-check-circle', 'test.good')
    const cpu =
      result.model === undefined
        ? melsecJw.text('test.unidentified')
        : [result.model, result.series].filter(Boolean).join(' · ')
    $('<div>')
      .text(melsecJw.text('test.cpu', { cpu: cpu }))
      .appendTo(box)
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

  function prepareConnection(node) {
    melsecJw.fill(node, 'config-')
    // A new connection only: what is stored stays, whoever looks at it.
    if (!RED.nodes.node(node.id) && RED.i18n.lang() === 'ja') $('#node-config-input-encoding').val('shift-jis')
    const series = $('#node-config-input-profile')
    Object.keys(RED.settings.melsecJwConnectionProfiles || {}).forEach((id) => {
      $('<option>')
        .val(id)
        .text(node._(`option.${id}`))
        .appendTo(series)
    })
    series.val(node.profile || '')
    const tabs = RED.tabs.create({
      id: 'melsec-jw-tabs',
      onchange: (tab) => {
        $('.melsec-jw-tab').hide()
        $(`#${tab.id}`).show()
      },
    })
    ;['plc', 'line', 'values'].forEach((name) => {
      tabs.addTab({ id: `melsec-jw-tab-${name}`, label: node._(`tab.${name}`) })
    })
    tabs.activateTab('melsec-jw-tab-plc')
    $('#node-config-input-code').on('change', showAscii)
    $('#node-config-input-profile')
      .on('change', function () {
        showSeries(node, $(this).val())
      })
      .trigger('change')
    $('#node-config-input-reconnectLongest').attr('placeholder', RED.settings.melsecJwConnectionLongestPause)
    $('#node-config-input-allowWrites, #node-config-input-allowControl')
      .on('change', () => {
        const writes = $('#node-config-input-allowWrites').prop('checked')
        const controls = $('#node-config-input-allowControl').prop('checked')
        $('#melsec-jw-allowed').text(
          node._(
            writes && controls
              ? 'note.allowBoth'
              : writes
                ? 'note.allowWrites'
                : controls
                  ? 'note.allowControl'
                  : 'note.allow',
          ),
        )
      })
      .trigger('change')
    function askPlc(path, running, show) {
      const buttons = $('#melsec-jw-test').prop('disabled', true)
      $('#melsec-jw-test-result').removeClass('melsec-jw-good melsec-jw-bad').text(melsecJw.text(running))
      melsecJw
        .post(`melsec-jw/connection/${path}`, { id: node.id, settings: typedSettings(node._def) })
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
        $('<button type="button" class="red-ui-button red-ui-button-small">')
          .text(melsecJw.text('test.find'))
          .appendTo(box)
          .on('click', () => {
            askPlc('find', 'test.finding', (found) => {
              if (found.ok) showFound(node, found.lines)
              else showFailure(found)
            })
          })
      })
    })
  }

  /** The digits of X and Y are a setting of some series only: the others always have hexadecimal ones. */
  function showAscii() {
    const ascii = $('#node-config-input-code').val() === 'ascii'
    const facts = RED.settings.melsecJwConnectionProfiles?.[$('#node-config-input-profile').val()]
    const fixed = facts !== undefined && facts.asciiXy !== 'setting'
    if (fixed) $('#node-config-input-asciiXy').val('')
    $('.melsec-jw-ascii').toggle(ascii)
    $('.melsec-jw-ascii-xy').toggle(ascii && !fixed)
  }

  /** What the chosen series makes of fields that are left empty. */
  function showSeries(node, profile) {
    const facts = RED.settings.melsecJwConnectionProfiles?.[profile] || {}
    const frame = facts.frame ? node._(`option.${facts.frame}`) : ''
    const radix = facts.xyRadix ? node._(facts.xyRadix === 8 ? 'option.octalXy' : 'option.hexadecimalXy') : ''
    const ofW = facts.wRadix ? node._(facts.wRadix === 10 ? 'option.decimalW' : 'option.hexadecimalW') : ''
    function name(value) {
      return node._('option.seriesDefault') + (value === '' ? '' : ` (${value})`)
    }
    // The editor would put the text of data-i18n back.
    $('#node-config-input-frame option[value=""]').removeAttr('data-i18n').text(name(frame))
    $('#node-config-input-xyRadix option[value=""]').removeAttr('data-i18n').text(name(radix))
    $('#node-config-input-wRadix option[value=""]').removeAttr('data-i18n').text(name(ofW))
    showAscii()
    $('#node-config-input-monitoringTimer').attr(
      'placeholder',
      facts.monitoringTimer === undefined ? '' : facts.monitoringTimer,
    )
  }

  window.melsecJw = Object.assign(window.melsecJw || {}, { prepareConnection })
})()
