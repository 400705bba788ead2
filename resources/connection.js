// The dialog of a connection: what the way to the PLC and its series make of its fields.
;(() => {
  function prepareConnection(node) {
    melsecJw.fill(node, 'config-')
    // A new connection only: what is stored stays, whoever looks at it.
    if (!RED.nodes.node(node.id) && RED.i18n.lang() === 'ja') $('#node-config-input-encoding').val('shift-jis')
    const series = $('#node-config-input-profile')
    showChoices(node, node.profile)
    $('.melsec-jw-form').last().data('connection', node.id)
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
    // The line may have been edited from here, too.
    $('#node-config-input-way, #node-config-input-line').on('change', () => {
      showChoices(node, series.val())
      series.trigger('change')
    })
    $('#node-config-input-family, #node-config-input-header, #node-config-input-areas').on('change', () => {
      series.trigger('change')
    })
    $('#node-config-input-profile')
      .on('change', function () {
        showWay($(this).val())
        showSeries(node, $(this).val())
        showFamily(node)
      })
      .trigger('change')
    $('#node-config-input-reconnectLongest').attr('placeholder', RED.settings.melsecJwConnectionLongestPause)
    $('#node-config-input-allowWrites, #node-config-input-allowControl, #node-config-input-allowParameters').on(
      'change',
      () => {
        showAllowed(node)
      },
    )
    showAllowed(node)
    melsecJw.prepareTest(node)
  }

  function isJw() {
    return $('#node-config-input-family').val() === 'jw'
  }

  function isOnLine() {
    return !isJw() && $('#node-config-input-way').val() === 'serial'
  }

  /** What flows may do with the PLC. */
  function showAllowed(node) {
    const [writes, controls, parameters] = ['Writes', 'Control', 'Parameters'].map((what) =>
      $(`#node-config-input-allow${what}`).prop('checked'),
    )
    const both = writes && controls
    const ofMelsec = node._(
      both ? 'note.allowBoth' : writes ? 'note.allowWrites' : controls ? 'note.allowControl' : 'note.allow',
    )
    const ofJw = [
      writes && node._('note.jwWrites'),
      controls && node._('note.jwControl'),
      parameters && node._('note.jwParameters'),
    ].filter(Boolean)
    $('#melsec-jw-allowed').text(isJw() ? ofJw.join(' ') || node._('note.allow') : ofMelsec)
  }

  /** What the family of the PLC has, and nothing else. Comes last, because it hides what the way would show. */
  function showFamily(node) {
    const jw = isJw()
    $('.melsec-jw-of-jw').toggle(jw)
    if (jw) $('.melsec-jw-of-melsec').hide()
    else $('.melsec-jw-always-melsec').show()
    showAllowed(node)
    const header = $('#node-config-input-header').val()
    $('.melsec-jw-header-relay').toggle(jw && header === 'relay')
    $('.melsec-jw-header-bytes').toggle(jw && header === 'bytes')
    $('.melsec-jw-own-areas').toggle(jw && $('#node-config-input-areas').val() === 'own')
    // The editor would put the text of data-i18n back.
    $('label[for="node-config-input-allowControl"] span')
      .removeAttr('data-i18n')
      .text(node._(jw ? 'label.allowControlJw' : 'label.allowControl'))
  }

  /** The line that is chosen in the dialog, as the editor has it. */
  function chosenLine() {
    return RED.nodes.node($('#node-config-input-line').val())
  }

  /** The series that the chosen way can have. */
  function showChoices(node, chosen) {
    const series = $('#node-config-input-profile')
    const { frame } = chosenLine() || {}
    series.find('option[value!=""]').remove()
    Object.entries(RED.settings.melsecJwConnectionProfiles || {}).forEach(([id, facts]) => {
      const fits = isOnLine()
        ? facts.serial !== undefined && (!frame || facts.serial.frames.includes(frame))
        : facts.serial === undefined
      if (!fits && id !== node.profile) return
      $('<option>')
        .val(id)
        .text(node._(`option.${id}`))
        .appendTo(series)
    })
    // One that the way cannot have is chosen anew: nothing is guessed.
    const kept = melsecJw.isSeries(chosen, isOnLine())
    series.find('option').each(function () {
      if (this.value && !melsecJw.isSeries(this.value, isOnLine())) $(this).remove()
    })
    series.val(kept ? chosen : '')
  }

  /** The fields of the way, and of what the series reaches by it. */
  function showWay(profile) {
    const onLine = isOnLine()
    const serial = RED.settings.melsecJwConnectionProfiles?.[profile]?.serial
    $('.melsec-jw-by-network').toggle(!onLine)
    $('.melsec-jw-on-line').toggle(onLine)
    $('.melsec-jw-1c').toggle(onLine && chosenLine()?.frame === '1C')
    // A CPU with a line of its own is all that is reached there; C24 modules relay.
    $('.melsec-jw-relayed').toggle(!onLine || serial?.reach === 'c24')
    $('#melsec-jw-stations').text(serial ? melsecJw.text('line.stations', { last: serial.lastStation }) : '')
  }

  /** The digits of X and Y are a setting of some series only: the others always have hexadecimal ones. */
  function showAscii() {
    const ascii = isOnLine() ? chosenLine()?.messageFormat !== '5' : $('#node-config-input-code').val() === 'ascii'
    const facts = RED.settings.melsecJwConnectionProfiles?.[$('#node-config-input-profile').val()]
    const fixed = facts !== undefined && facts.asciiXy !== 'setting'
    if (fixed) $('#node-config-input-asciiXy').val('')
    $('.melsec-jw-ascii').toggle(ascii)
    $('.melsec-jw-ascii-xy').toggle(ascii && !fixed)
    $('.melsec-jw-w').toggle(!(isOnLine() && ascii))
  }

  /** What the chosen series makes of fields that are left empty. */
  function showSeries(node, profile) {
    const facts = RED.settings.melsecJwConnectionProfiles?.[profile] || {}
    // On a serial line the line says it.
    const frame = facts.frame && !facts.serial ? node._(`option.${facts.frame}`) : ''
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
