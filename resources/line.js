// The dialog of a serial line: the ports of the machine, and what frame and format ask for.
;(() => {
  function prepareLine(node) {
    melsecJw.fill(node, 'config-')
    const form = $('#melsec-jw-line')
    if (node.sumCheck === undefined) $('#node-config-input-sumCheck').prop('checked', true)
    const rates = $('#node-config-input-baudRate')
    ;(RED.settings.melsecJwLineBaudRates || []).forEach((rate) => {
      $('<option>').val(String(rate)).text(`${rate} bps`).appendTo(rates)
    })
    rates.val(node.baudRate || node._def.defaults.baudRate.value)
    const tabs = RED.tabs.create({
      id: 'melsec-jw-line-tabs',
      onchange: (tab) => {
        form.find('.melsec-jw-tab').hide()
        $(`#${tab.id}`).show()
      },
    })
    ;['port', 'advanced'].forEach((name) => {
      tabs.addTab({ id: `melsec-jw-line-${name}`, label: node._(`tab.${name}`) })
    })
    tabs.activateTab('melsec-jw-line-port')
    $('#node-config-input-transport').on('change', showPlace).trigger('change')
    $('#node-config-input-frame').on('change', showFormats)
    $('#node-config-input-messageFormat').on('change', showLengths)
    showFormats()
    $('#melsec-jw-ports').on('click', askPorts)
  }

  function showPlace() {
    const remote = $('#node-config-input-transport').val() === 'tcp'
    $('.melsec-jw-own-port').toggle(!remote)
    $('.melsec-jw-server').toggle(remote)
  }

  /** The formats that the frame has. */
  function showFormats() {
    const formats = RED.settings.melsecJwLineFormats?.[$('#node-config-input-frame').val()]
    const format = $('#node-config-input-messageFormat')
    format.find('option').each(function () {
      $(this).prop('disabled', formats !== undefined && !formats.includes(Number(this.value)))
    })
    if (format.find('option:selected').prop('disabled')) format.val('1')
    showLengths()
  }

  /** Format 5 sends binary data, which need 8 bits. */
  function showLengths() {
    const binary = $('#node-config-input-messageFormat').val() === '5'
    const length = $('#node-config-input-dataLength')
    length.find('option[value="7"]').prop('disabled', binary)
    if (binary) length.val('8')
  }

  function askPorts() {
    const button = $('#melsec-jw-ports').prop('disabled', true)
    const box = $('#melsec-jw-port-list').removeClass('melsec-jw-bad').text(melsecJw.text('line.asking'))
    melsecJw
      .post('melsec-jw/line/ports', {})
      .then(
        (answer) =>
          answer.ok ? showPorts(box.empty(), answer.ports) : box.addClass('melsec-jw-bad').text(answer.message),
        (failed) => {
          const key = failed.status === 401 || failed.status === 403 ? 'line.notPermitted' : 'test.noAnswer'
          box.addClass('melsec-jw-bad').text(failed.responseJSON?.message || melsecJw.text(key))
        },
      )
      .always(() => {
        button.prop('disabled', false)
      })
  }

  /** One click takes a port. A name that lasts is better than the one of the moment. */
  function showPorts(box, ports) {
    if (ports.length === 0) box.text(melsecJw.text('line.noPorts'))
    ports.forEach((port) => {
      $('<div>')
        .append(
          $('<button type="button" class="red-ui-button red-ui-button-small">')
            .text([port.path, port.manufacturer].filter(Boolean).join(' · '))
            .on('click', () => {
              $('#node-config-input-path')
                .val(port.lastingPath || port.path)
                .trigger('change')
              box.empty()
            }),
        )
        .appendTo(box)
    })
  }

  window.melsecJw = Object.assign(window.melsecJw || {}, { prepareLine })
})()
