// The list of items in the dialogs of read and write: its rows, the check of what is typed, its height.
;(() => {
  const LEAST_HEIGHT = 260

  function deviceTitle(explanation) {
    const key = `device.${explanation.device}`
    const title = melsecJw.text(key)
    return title.indexOf(key) >= 0 ? explanation.title : title
  }

  /** One line: what an item of a Sharp JW is, and where it lies. */
  function describeOperand({ text, type, count, where }) {
    const bit = where.bit === undefined ? '' : melsecJw.text('explain.bitOf', { bit: where.bit })
    return [
      text.replace(/:.*$/, ''),
      type + (count === undefined ? '' : ` × ${count}`),
      melsecJw.text(`explain.in.${where.in}`, { file: where.file, at: where.at }),
      bit,
      melsecJw.text('explain.radix8'),
    ]
      .filter(Boolean)
      .join(' · ')
  }

  /** One line: what the item is. */
  function describe(explanation) {
    if (explanation.label !== undefined) {
      return [
        melsecJw.text('explain.label', { name: explanation.label }),
        explanation.count && `× ${explanation.count}`,
        melsecJw.text(explanation.type ? 'explain.checkedType' : 'explain.plcType', { type: explanation.type }),
      ]
        .filter(Boolean)
        .join(' · ')
    }
    if (explanation.where !== undefined) return describeOperand(explanation)
    const range = explanation.first + (explanation.last === explanation.first ? '' : ` – ${explanation.last}`)
    const size = melsecJw.text(`explain.${explanation.size.unit}${explanation.size.count === 1 ? '' : 's'}`, {
      count: explanation.size.count,
    })
    const type = explanation.type + (explanation.count === undefined ? '' : ` × ${explanation.count}`)
    const parts = [range, deviceTitle(explanation), type, size, melsecJw.text(`explain.radix${explanation.radix}`)]
    // First, because a line that is long is not read to its end.
    if (explanation.beyond) {
      const series = melsecJw.text(`option.${explanation.beyond.profile}`)
      parts.unshift(melsecJw.text('explain.beyond', { series, last: explanation.beyond.last }))
    }
    if (explanation.requests > 1) parts.push(melsecJw.text('explain.requests', { count: explanation.requests }))
    return parts.join(' · ')
  }

  /**
   * Checks the rows of a list a moment after each change.
   * @param connection function that gives the id of the chosen connection
   * @param rows function that gives [{ address, type, show(ok, text) }]
   */
  function checker(connection, rows) {
    return melsecJw.delayed((isCurrent) => {
      const current = rows().filter((row) => {
        if (row.address === '') row.show(true, '')
        return row.address !== ''
      })
      if (current.length === 0) return
      const items = current.map((row) => ({ address: row.address, type: row.type }))
      melsecJw.post('melsec-jw/address/check', { settings: melsecJw.speechOf(connection()), items: items }).then(
        (reply) => {
          if (!isCurrent()) return
          reply.results.forEach((result, index) => {
            current[index].show(result.ok, result.ok ? describe(result) : result.message, Boolean(result.beyond))
          })
        },
        () => {
          if (isCurrent())
            current.forEach((row) => {
              row.show(true, melsecJw.text('explain.unavailable'))
            })
        },
      )
    })
  }

  /** `STRING(20)` is chosen as STRING with the length beside it. */
  function typeFields(container, type, changed, facts) {
    const parts = /^\s*([^()]*?)\s*(?:\(\s*(\d+)\s*\))?\s*$/.exec(type || '') || ['', type, '']
    const name = parts[1].toUpperCase()
    // The length stands inside the column of the type, so that the columns of all rows stay below their heads.
    container = $('<div class="melsec-jw-typecell">').appendTo(container)
    const select = $('<select class="melsec-jw-type">')
      .attr('aria-label', melsecJw.text('label.itemType'))
      .appendTo(container)
    /** The types of the family of the PLC, and what was chosen before. */
    function fill(chosen) {
      const names = facts().types
      select.empty().append($('<option>').val('').text(melsecJw.text('option.deviceType')))
      names.concat(chosen === '' || names.indexOf(chosen) >= 0 ? [] : [chosen]).forEach((each) => {
        $('<option>').val(each).text(each).appendTo(select)
      })
      select.val(chosen)
    }
    fill(name)
    const length = $('<input type="text" class="melsec-jw-length">')
      .attr('aria-label', melsecJw.text('label.length'))
      .appendTo(container)
    length.attr('placeholder', melsecJw.text('placeholder.length')).val(parts[2] || '')
    function hasLength() {
      return /STRING$/.test(select.val()) || (length.val() !== '' && select.val() === name)
    }
    function show() {
      length.toggle(hasLength())
    }
    select.on('change', () => {
      if (hasLength() && length.val() === '') length.val('20')
      show()
      changed()
    })
    length.on('input', changed)
    show()
    return {
      value: () => {
        const digits = length.val().trim()
        return select.val() + (hasLength() && digits !== '' ? `(${digits})` : '')
      },
      refill: () => {
        fill(select.val())
      },
    }
  }

  /** Name, address and type of one row of an editable list, with the line below that says what it is. */
  function row(container, item, changed, facts) {
    const line = $('<div class="melsec-jw-row">').appendTo(container)
    const name = $('<input type="text" class="melsec-jw-name">')
      .attr('aria-label', melsecJw.text('label.itemName'))
      .appendTo(line)
    name.attr('placeholder', melsecJw.text('placeholder.itemName')).val(item.name || '')
    const address = $('<input type="text" class="melsec-jw-address" spellcheck="false">')
      .attr('aria-label', melsecJw.text('label.itemAddress'))
      .appendTo(line)
    address.val(item.address || '')
    const type = typeFields(line, item.type, changed, facts)
    function showFamily() {
      address.attr('placeholder', melsecJw.text(`placeholder.itemAddress.${facts().name}`))
    }
    showFamily()
    const hint = $('<div class="melsec-jw-hint" aria-live="polite">').appendTo(container)
    address.on('input', changed)
    return {
      line: line,
      value: () => ({ name: name.val().trim(), address: address.val().trim(), type: type.value() }),
      /** Another connection may have a PLC of another family. */
      refit: () => {
        type.refill()
        showFamily()
      },
      show: (ok, message, doubt) => {
        hint.toggleClass('melsec-jw-bad', !ok).toggleClass('melsec-jw-doubt', Boolean(doubt)).text(message)
        address.toggleClass('input-error', !ok).attr('aria-invalid', String(!ok))
      },
    }
  }

  /** The names of the columns, above the rows and not scrolled with them. */
  function head() {
    const line = $('<div class="melsec-jw-row melsec-jw-head">')
    ;[
      ['name', 'itemName'],
      ['address', 'itemAddress'],
      ['typecell', 'itemType'],
    ].forEach((each) => {
      $('<div>')
        .addClass(`melsec-jw-${each[0]}`)
        .text(melsecJw.text(`label.${each[1]}`))
        .appendTo(line)
    })
    return line
  }

  /** The list takes what the other rows of the dialog leave of its height, and no less than shows a row or two. */
  function giveHeight(element, size) {
    const rows = $('.red-ui-tray-body .melsec-jw-form').last().children('.form-row:visible').not('.melsec-jw-list')
    const others = rows.toArray().reduce((sum, row) => sum + $(row).outerHeight(true), 0)
    element.editableList('height', Math.max(LEAST_HEIGHT, size.height - others - 40))
  }

  /** The editable list of a read or write dialog. @param more adds what only that node has to a row */
  function list(element, connection, items, more) {
    const check = checker(connection, () => rowsOf().map((each) => $.extend({ show: each.show }, each.value())))
    function rowsOf() {
      return element
        .editableList('items')
        .toArray()
        .map((each) => each.data('melsecJw'))
    }
    element.editableList({
      addButton: melsecJw.text('button.addRow'),
      removable: true,
      sortable: true,
      // Not `auto`, with which the list would not scroll; the dialog gives it its height when it is shown.
      height: LEAST_HEIGHT,
      header: head(),
      addItem: (container, _index, item) => {
        const made = row(container, item, check.soon, () => melsecJw.factsOf(connection()))
        const extra = more ? more(container, item, made) : () => ({})
        container.data('melsecJw', { show: made.show, refit: made.refit, value: () => $.extend(made.value(), extra()) })
        check.soon()
      },
      removeItem: check.soon,
    })
    items.forEach((item) => {
      element.editableList('addItem', item)
    })
    // The list scrolls to each row that is added, a moment later: what was there before is shown from its start.
    setTimeout(() => element.parent().scrollTop(0), 0)
    return {
      check: () => {
        rowsOf().forEach((each) => {
          each.refit()
        })
        check.soon()
      },
      fit: (size) => {
        giveHeight(element, size)
      },
      close: check.stop,
      /** Without rows that were never filled in. */
      rows: () =>
        rowsOf()
          .map((each) => each.value())
          .filter((each) => each.name || each.address),
    }
  }

  /** Rows that can be deployed: so many at least, each with an address, no two with the same name. */
  function areRows(rows, least) {
    rows = (rows || []).filter((each) => each.name || each.address)
    if (rows.length < least) return false
    const names = rows.map((each) => each.name || each.address)
    return rows.every((each) => Boolean(each.address)) && new Set(names).size === names.length
  }

  /** What a node without a name is called: its first item, and how many more there are. */
  function nameOfRows(rows) {
    const names = (rows || []).map((each) => each.name || each.address).filter(Boolean)
    return names.length > 1 ? `${names[0]} +${names.length - 1}` : names[0] || ''
  }

  window.melsecJw = Object.assign(window.melsecJw || {}, { list, areRows, nameOfRows })
})()
