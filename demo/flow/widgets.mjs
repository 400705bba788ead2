// The dashboard's widgets with all the settings they store, so that a flow node says only what differs.

export const size = (width, height) => ({ width: String(width), height: String(height) })

/** @param value JSONata expression of the message */
export function gauge(group, { value, ...node }) {
  return {
    ...node,
    type: 'ui-gauge',
    group,
    order: 1,
    value,
    valueType: 'jsonata',
    ...size(3, 6),
    gstyle: 'rounded',
    title: '',
    alwaysShowTitle: false,
    floatingTitlePosition: 'top-left',
    icon: '',
    prefix: '',
    suffix: '',
    min: 0,
    sizeThickness: 16,
    sizeGap: 4,
    sizeKeyThickness: 8,
    styleRounded: true,
    styleGlow: false,
    className: '',
  }
}

/** @param value JSONata expression of the message */
export function text(group, { value, ...node }) {
  return {
    ...node,
    type: 'ui-text',
    group,
    order: 2,
    ...size(3, 1),
    name: '',
    format: '{{msg.payload}}',
    layout: 'row-spread',
    style: false,
    font: '',
    fontSize: 16,
    color: '#717171',
    wrapText: false,
    className: '',
    value,
    valueType: 'jsonata',
  }
}

/** A trend of `y` in the payload, a number, or `null` for a gap. */
export function chart(group, { ymax, colour, ...node }) {
  return {
    ...node,
    type: 'ui-chart',
    group,
    name: '',
    chartType: 'line',
    // Not by a key of the payload (json): of such series the dashboard forgets the history.
    category: node.label,
    categoryType: 'str',
    xAxisLabel: '',
    xAxisProperty: '',
    xAxisPropertyType: 'timestamp',
    xAxisType: 'time',
    xAxisFormat: '',
    xAxisFormatType: 'HH:mm:ss',
    xmin: '',
    xmax: '',
    yAxisLabel: '',
    yAxisProperty: 'y',
    yAxisPropertyType: 'property',
    ymin: '0',
    ymax: String(ymax),
    bins: 10,
    action: 'append',
    stackSeries: false,
    pointShape: 'false',
    pointRadius: 1,
    showLegend: false,
    // Five minutes: some four batches.
    removeOlder: '5',
    removeOlderUnit: '60',
    removeOlderPoints: '',
    colors: [colour, '#FF0000', '#FF7F0E', '#2CA02C', '#A347E1', '#D62728', '#FF9896', '#9467BD', '#C5B0D5'],
    textColor: ['#666666'],
    textColorDefault: true,
    gridColor: ['#e5e5e5'],
    gridColorDefault: true,
    ...size(3, 7),
    className: '',
    interpolation: 'linear',
  }
}

/** @param format a Vue component */
export function template(group, { format, ...node }) {
  return {
    order: 1,
    ...node,
    type: 'ui-template',
    group,
    page: '',
    ui: '',
    ...size(3, 6),
    head: '',
    format,
    storeOutMessages: true,
    passthru: false,
    resendOnRefresh: true,
    templateScope: 'local',
    className: '',
  }
}

/** Styles of every page. */
export function style(ui, { css, ...node }) {
  return { ...template('', { ...node, format: css }), ui, ...size(0, 0), templateScope: 'site:style' }
}

/** A button that sends true. */
export function button(group, { topic, icon, colour, ...node }) {
  return {
    ...node,
    type: 'ui-button',
    group,
    name: '',
    ...size(3, 1),
    emulateClick: false,
    tooltip: '',
    color: '',
    bgcolor: '',
    className: '',
    icon,
    iconPosition: 'left',
    payload: 'true',
    payloadType: 'bool',
    topic,
    topicType: 'str',
    buttonColor: colour,
    textColor: '#ffffff',
    iconColor: '#ffffff',
    enableClick: true,
    enablePointerdown: false,
    pointerdownPayload: '',
    pointerdownPayloadType: 'str',
    enablePointerup: false,
    pointerupPayload: '',
    pointerupPayloadType: 'str',
  }
}

/** Sends every position on the way, so that the keyboard works, too; the flow waits until it stands still. */
export function slider(group, { topic, ...node }) {
  return {
    ...node,
    type: 'ui-slider',
    group,
    name: '',
    tooltip: '',
    ...size(3, 2),
    passthru: false,
    outs: 'all',
    topic,
    topicType: 'str',
    thumbLabel: 'true',
    showTicks: 'false',
    className: '',
    iconPrepend: '',
    iconAppend: '',
    color: '',
    colorTrack: '',
    colorThumb: '',
    showTextField: true,
  }
}

export function numberInput(group, { topic, ...node }) {
  return {
    ...node,
    type: 'ui-number-input',
    group,
    name: '',
    ...size(3, 1),
    topic,
    topicType: 'str',
    step: 1,
    tooltip: '',
    delay: 300,
    passthru: false,
    sendOnDelay: false,
    sendOnBlur: true,
    sendOnEnter: true,
    className: '',
    clearable: false,
    icon: '',
    iconPosition: 'left',
    iconInnerPosition: 'inside',
    spinner: 'default',
  }
}

/** @param options pairs of a number and its title */
export function dropdown(group, { topic, options, ...node }) {
  return {
    ...node,
    type: 'ui-dropdown',
    group,
    name: '',
    tooltip: '',
    ...size(3, 1),
    passthru: false,
    multiple: false,
    chips: false,
    clearable: false,
    options: options.map(([value, label]) => ({ label, value, type: 'num' })),
    payload: '',
    topic,
    topicType: 'str',
    className: '',
    typeIsComboBox: false,
    msgTrigger: 'onChange',
  }
}

export function notification(ui, node) {
  return {
    ...node,
    type: 'ui-notification',
    ui,
    position: 'top right',
    colorDefault: false,
    color: '#b3261e',
    displayTime: '8',
    showCountdown: true,
    outputs: 1,
    allowDismiss: true,
    dismissText: 'Close',
    allowConfirm: false,
    confirmText: 'Confirm',
    raw: false,
    className: '',
  }
}
