// The dashboard's configuration nodes: theme, a page for each PLC, and the groups on it.
import { readFileSync } from 'node:fs'
import { plcs } from '../plcs.mjs'
import { tab } from './canvas.mjs'
import { plantOf } from './plants.mjs'
import { style } from './widgets.mjs'

export const ui = 'demo-ui'
const theme = 'demo-theme'

/** Groups of a page, in order: width in columns of twelve, height in rows. What has no title gets it from the plant. */
const groups = [
  { name: 'head', title: 'Connection', width: 12, height: 1, showTitle: false },
  { name: 'left', width: 3, height: 7 },
  { name: 'middle', width: 3, height: 7 },
  { name: 'trend', title: 'Trend', width: 6, height: 7 },
  { name: 'states', width: 3, height: 6 },
  { name: 'counts', width: 3, height: 6 },
  { name: 'setpoints', width: 3, height: 6 },
  { name: 'operate', title: 'Operation', width: 3, height: 6 },
]

export const groupId = (plc, name) => `${plc.id}-group-${name}`
const pageId = (plc) => `${plc.id}-page`

export function text(file) {
  return readFileSync(new URL(file, import.meta.url), 'utf8').replaceAll(/^\/\* biome-ignore.*\n/gm, '')
}

export function dashboard() {
  return [
    {
      id: ui,
      type: 'ui-base',
      name: 'Demo plant',
      path: '/dashboard',
      appIcon: '',
      includeClientData: true,
      acceptsClientConfig: ['ui-notification', 'ui-control'],
      showPathInSidebar: false,
      headerContent: 'page',
      navigationStyle: 'icon',
      titleBarStyle: 'default',
      showReconnectNotification: true,
      notificationDisplayTime: 1,
      showDisconnectNotification: true,
      allowInstall: false,
    },
    {
      id: theme,
      type: 'ui-theme',
      name: 'Control room',
      colors: {
        surface: '#15324a',
        primary: '#1f6fb2',
        bgPage: '#dfe5eb',
        groupBg: '#fbfcfd',
        groupOutline: '#c6d0da',
      },
      sizes: {
        density: 'compact',
        pagePadding: '12px',
        groupGap: '12px',
        groupBorderRadius: '6px',
        widgetGap: '10px',
      },
    },
    ...plcs.flatMap(pageOf),
  ]
}

/** A tab for what belongs to no PLC. */
export function lookTab() {
  const canvas = tab('look', 'Look', 'Styles of the dashboard pages.')
  canvas.frame('frame', 'Look of every page', { x: 20, y: 20, width: 300, rows: 1 }, [
    style(ui, { id: 'style', column: 0, row: 0, name: 'Styles', css: text('style.css') }),
  ])
  return canvas.nodes
}

function pageOf(plc, index) {
  const page = {
    id: pageId(plc),
    type: 'ui-page',
    name: `${plc.page}: ${plc.title}`,
    ui,
    path: `/${plc.id}`,
    icon: `numeric-${index + 1}-box`,
    layout: 'grid',
    theme,
    breakpoints: [
      { name: 'Default', px: '0', cols: '3' },
      { name: 'Tablet', px: '576', cols: '6' },
      { name: 'Desktop', px: '1000', cols: '12' },
    ],
    order: index + 1,
    className: '',
    visible: 'true',
    disabled: 'false',
  }
  const { process } = plantOf(plc)
  const frames = groups.map(({ name, title = process.groups[name], width, height, showTitle = true }, order) => ({
    id: groupId(plc, name),
    type: 'ui-group',
    name: title,
    page: page.id,
    width: String(width),
    height: String(height),
    order: order + 1,
    showTitle,
    className: '',
    visible: 'true',
    disabled: 'false',
    groupType: 'default',
  }))
  return [page, ...frames]
}
